#include "capture_format/import/gltf_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf_instances.h"
#include "capture_format/inspection.h"
#include "capture_format/reader.h"
#include "capture_format/view.h"

namespace strata::gltf {
namespace {

constexpr std::array<std::string_view, 10> supported_extensions = {
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",    "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_materials_ior",       "KHR_materials_transmission", "KHR_materials_unlit", "KHR_materials_volume",
    "KHR_mesh_quantization",   "KHR_texture_transform"};

bool is_supported(const std::string& extension) {
    return std::find(supported_extensions.begin(), supported_extensions.end(), extension) != supported_extensions.end();
}

bool is_invertible(const glm::dmat4& matrix) {
    const double volume = glm::determinant(glm::dmat3(matrix));
    return volume != 0 && std::isfinite(volume);
}

bool is_skinned(const Node& node, const Primitive& primitive) {
    return node.skin >= 0 && primitive.attributes.contains("JOINTS_0");
}

Bounds bounds_of(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) bounds.add(glm::dvec3(position));
    return bounds;
}

/// Names may be of any length in a glTF, a data URI of a megabyte for one. Cuts never split a UTF-8 character.
void shorten_names(Frame& frame) {
    const auto shorten = [](auto& list) {
        for (auto& item : list) {
            std::size_t length = std::min(item.name.size(), longest_text);
            while (length < item.name.size() && length > 0 && (item.name[length] & 0xc0) == 0x80) --length;
            item.name.resize(length);
        }
    };
    shorten(frame.textures);
    shorten(frame.meshes);
    shorten(frame.materials);
    shorten(frame.draws);
    shorten(frame.lights);
}

}  // namespace

struct FrameSource::Making {
    Frame frame;
    NodePose pose;
    std::vector<glm::dmat4> to_world, previous_to_world;  ///< of every node
    MemoryBudget budget;                                  ///< for what is this frame's alone
    std::vector<double> weights;                          ///< of the morph targets of the node at hand
    /// Meshes made for this pose: by primitive, the node when it has a skin, and weights.
    std::map<std::tuple<const Primitive*, const Node*, std::vector<double>>, std::uint32_t> meshes;
    std::vector<glm::dvec3> corners;  ///< of every draw's box, world
    std::vector<Bounds> boxes;        ///< of every mesh, object space; made when first asked for
    Bounds scene;
};

void FrameSource::warn(std::string sentence) {
    if (warned_.insert(sentence).second) warnings_.push_back(std::move(sentence));
}

Result<void> FrameSource::check_extensions() {
    for (const std::string& extension : document_.extensions_required) {
        if (!is_supported(extension) && !is_ignored_material_extension(extension)) {
            return fail(Fault::bad_input, "import.gltf.extension", "the glTF requires {extension:.80}, which is not supported",
                        extension);
        }
    }
    for (const std::string& extension : document_.extensions_used) {
        const bool named_with_its_materials = is_ignored_material_extension(extension);
        if (!is_supported(extension) && !named_with_its_materials) warn(fmt::format("{:.80} is ignored", extension));
    }
    return {};
}

Result<void> FrameSource::read_animation() {
    const auto index = find_animation(document_, options_.animation);
    if (!index) return index.error();
    moving_.assign(document_.nodes.size(), false);
    if (*index < 0 && options_.fps)
        return fail(Fault::usage, "import.gltf.fps_unused", "--fps has no effect: the glTF has no animation to sample");
    if (*index < 0) return {};
    const Animation& animation = document_.animations[static_cast<std::size_t>(*index)];
    auto clip = Clip::read(document_, animation, budget_);
    if (!clip) return clip.error();
    for (const std::string& warning : clip->warnings()) warn(warning);
    if (document_.animations.size() > 1 && options_.animation.empty()) {
        warn(fmt::format("the first of {} animations is used, '{:.60}'", document_.animations.size(), animation.name));
    }
    moving_ = clip->animated(document_.nodes.size());
    for (const Hierarchy::Step& step : hierarchy_.steps) {  // parents come first
        if (step.parent >= 0 && moving_[static_cast<std::size_t>(step.parent)])
            moving_[static_cast<std::size_t>(step.node)] = true;
    }
    clip_ = *std::move(clip);
    return {};
}

Result<void> FrameSource::read() {
    if (const auto checked = check_extensions(); !checked) return checked;
    auto hierarchy = walk_nodes(document_);
    if (!hierarchy) return hierarchy.error();
    hierarchy_ = *std::move(hierarchy);
    if (const auto read = read_animation(); !read) return read;
    auto surfaces = import_materials(document_, budget_, options_.take_texture);
    if (!surfaces) return surfaces.error();
    surfaces_ = *std::move(surfaces);
    for (const std::string& warning : surfaces_.warnings) warn(warning);
    geometry_.emplace(document_, surfaces_.materials, budget_);
    for (std::size_t step = 0; step < hierarchy_.shown; ++step) {
        const auto read = geometry_->read(document_.nodes[static_cast<std::size_t>(hierarchy_.steps[step].node)]);
        if (!read) return read;
    }
    for (const std::string& warning : geometry_->warnings()) warn(warning);
    return read_instances();
}

Result<void> FrameSource::read_instances() {
    for (std::size_t step = 0; step < hierarchy_.shown; ++step) {
        const Node& node = document_.nodes[static_cast<std::size_t>(hierarchy_.steps[step].node)];
        if (node.mesh < 0) continue;
        auto instances = gltf::read_instances(document_, node, budget_);
        if (!instances) return instances.error();
        instances_.emplace(&node, *std::move(instances));
    }
    return {};
}

FrameSource::Making FrameSource::begin(double time, double previous_time) const {
    const auto pose = [&](double at) { return clip_ ? clip_->pose(document_, at) : rest_pose(document_); };
    Making making{.pose = pose(time), .budget = budget_};
    making.to_world = to_world(document_, hierarchy_, making.pose);
    making.previous_to_world = previous_time == time ? making.to_world : to_world(document_, hierarchy_, pose(previous_time));
    return making;
}

/// A skin moves its mesh by the joints alone, wherever its node is (glTF 2.0, 3.7.3.3). The vertices are kept relative to the
/// node all the same, so that floats suffice far from the origin; only where the node has no inverse they are the world's.
glm::dmat4 FrameSource::object_to_world(const std::vector<glm::dmat4>& to_world, const Node& node,
                                        const Primitive& primitive) const {
    const glm::dmat4& placed = to_world[static_cast<std::size_t>(&node - document_.nodes.data())];
    return is_skinned(node, primitive) && !is_invertible(placed) ? glm::dmat4(1) : placed;
}

std::vector<glm::dmat4> FrameSource::joint_matrices(const Making& making, const Node& node) const {
    const std::vector<int>& joints = document_.skins[static_cast<std::size_t>(node.skin)].joints;
    std::vector<glm::dmat4> matrices = geometry_->inverse_bind_matrices(node.skin);
    const glm::dmat4& placed = making.to_world[static_cast<std::size_t>(&node - document_.nodes.data())];
    const glm::dmat4 from_world = is_invertible(placed) ? glm::inverse(placed) : glm::dmat4(1);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        matrices[i] = from_world * making.to_world[static_cast<std::size_t>(joints[i])] * matrices[i];
    }
    return matrices;
}

/// The mesh of a primitive for the pose at hand.
Result<std::uint32_t> FrameSource::moving_mesh(Making& making, const Node& node, const Primitive& primitive) {
    const bool skinned = is_skinned(node, primitive);
    const auto [known, fresh] = making.meshes.try_emplace({&primitive, skinned ? &node : nullptr, making.weights}, no_index);
    const Streams& streams = geometry_->streams(primitive);
    if (!fresh || streams.mesh.indices.empty()) return known->second;
    constexpr std::uint64_t bytes_per_corner = 80;  // a vertex of its own with every stream, and its index
    const auto room = making.budget.take(streams.mesh.indices.size() + streams.mesh.positions.size(), bytes_per_corner, "a pose");
    if (!room) return room.error();
    const auto joints = skinned ? joint_matrices(making, node) : std::vector<glm::dmat4>();
    const MeshSource& source = document_.meshes[static_cast<std::size_t>(node.mesh)];
    known->second = static_cast<std::uint32_t>(making.frame.meshes.size());
    making.frame.meshes.push_back(geometry_->posed_mesh(source, primitive, making.weights, joints));
    return known->second;
}

/// One draw for each instance of the node.
Result<void> FrameSource::add_draws(Making& making, const Node& node, const Primitive& primitive) {
    const bool deforms = Geometry::moves(node, primitive);
    const auto mesh = deforms ? moving_mesh(making, node, primitive) : Result(geometry_->fixed_mesh(primitive));
    if (!mesh) return mesh.error();
    if (*mesh == no_index) return {};
    Draw draw;
    draw.name = node.name.empty() ? making.frame.meshes[*mesh].name : node.name;
    draw.mesh = *mesh;
    draw.material = geometry_->material_of(primitive);
    const bool moves = moving_[static_cast<std::size_t>(&node - document_.nodes.data())];
    if (moves || deforms) draw.mobility = Mobility::moving;
    const glm::dmat4 to_world = object_to_world(making.to_world, node, primitive);
    const glm::dmat4 previous_to_world = object_to_world(making.previous_to_world, node, primitive);
    for (const glm::dmat4& instance : instances_.at(&node)) {
        draw.to_world = to_world * instance;
        draw.previous_to_world = previous_to_world * instance;
        if (!is_invertible(draw.to_world)) {
            warn(fmt::format("node '{:.60}' is left out where its scale is zero", node.name));
        } else if (const auto added = add_draw(making, draw); !added) {
            return added;
        }
    }
    return {};
}

Result<void> FrameSource::add_draw(Making& making, const Draw& draw) {
    if (const auto room = making.budget.take(1, sizeof(Draw) + 8 * sizeof(glm::dvec3), "a draw"); !room) return room;
    making.frame.draws.push_back(draw);
    while (making.boxes.size() <= draw.mesh) making.boxes.push_back(bounds_of(making.frame.meshes[making.boxes.size()]));
    const Bounds& box = making.boxes[draw.mesh];
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p((corner & 1) ? box.high.x : box.low.x, (corner & 2) ? box.high.y : box.low.y,
                           (corner & 4) ? box.high.z : box.low.z, 1);
        making.corners.emplace_back(draw.to_world * p);
        making.scene.add(making.corners.back());
    }
    return {};
}

Result<void> FrameSource::add_draws(Making& making) {
    making.frame.meshes = geometry_->fixed();
    for (std::size_t step = 0; step < hierarchy_.shown; ++step) {
        const auto index = static_cast<std::size_t>(hierarchy_.steps[step].node);
        const Node& node = document_.nodes[index];
        if (node.mesh < 0) continue;
        const MeshSource& mesh = document_.meshes[static_cast<std::size_t>(node.mesh)];
        making.weights = making.pose.weights[index];
        if (making.weights.empty()) making.weights = node.weights.empty() ? mesh.weights : node.weights;
        for (const Primitive& primitive : mesh.primitives) {
            if (const auto added = add_draws(making, node, primitive); !added) return added;
        }
    }
    return {};
}

/// What the wanted camera sees; nothing, with a warning, when it is not to be had.
std::optional<View> FrameSource::seen_by_camera(const std::vector<glm::dmat4>& to_world) {
    const int wanted = std::max(options_.camera, 0);
    for (std::size_t step = 0; step < hierarchy_.shown; ++step) {
        const auto node = static_cast<std::size_t>(hierarchy_.steps[step].node);
        if (document_.nodes[node].camera != wanted) continue;
        const auto view = camera_view(document_.cameras[static_cast<std::size_t>(wanted)], to_world[node],
                                      static_cast<double>(options_.width) / options_.height);
        if (view) return *view;
        warn(fmt::format("{}; a framing camera is used", view.error().sentence));
        return std::nullopt;
    }
    warn(fmt::format("camera {} is on no node of the scene; a framing camera is used", wanted));
    return std::nullopt;
}

/// A framing camera stands still and sees all that happens: it frames the scene at sixteen moments of the animation.
Result<void> FrameSource::frame_everything() {
    std::vector<glm::dvec3> corners;
    Bounds scene;
    std::vector<WorldTriangle> triangles;
    const double duration = clip_ ? clip_->duration() : 0;
    const int moments = duration > 0 ? 16 : 1;
    for (int moment = 0; moment < moments; ++moment) {
        const double time = duration * moment / moments;
        Making making = begin(time, time);
        if (const auto drawn = add_draws(making); !drawn) return drawn;
        for (const glm::dvec3& corner : making.corners) scene.add(corner);
        corners.insert(corners.end(), making.corners.begin(), making.corners.end());
        if (!options_.inside || moment > 0) continue;
        std::uint64_t count = 0;
        for (const Draw& draw : making.frame.draws) count += making.frame.meshes[draw.mesh].indices.size() / 3;
        if (const auto room = making.budget.has_room(count, 2 * sizeof(WorldTriangle), "a view of all triangles"); !room)
            return room;
        triangles = world_triangles(making.frame);
    }
    if (corners.empty()) corners = {glm::dvec3(-1), glm::dvec3(1)};
    framing_ = options_.eye      ? placed_view(scene, options_)
               : options_.inside ? inside_view(std::move(triangles), scene, options_)
                                 : framing_view(corners, scene, options_);
    return {};
}

Result<void> FrameSource::set_view(Making& making) {
    const std::size_t cameras = document_.cameras.size();
    if (options_.camera >= 0 && static_cast<std::size_t>(options_.camera) >= cameras) {
        return fail(Fault::usage, "import.gltf.camera_missing", "there is no camera {camera}; the glTF has {cameras}",
                    options_.camera, cameras);
    }
    const bool is_placed = options_.eye || options_.inside;
    const auto seen = cameras > 0 && !is_placed ? seen_by_camera(making.to_world) : std::nullopt;
    if (seen && (options_.azimuth || options_.elevation || options_.fov))
        return fail(Fault::usage, "import.gltf.view_unused",
                    "--fov, --azimuth and --elevation have no effect: the glTF's own camera is used. Leave them out, or place a "
                    "camera with --eye or --inside");
    if (!seen && !framing_) {
        if (const auto framed = frame_everything(); !framed) return framed;
    }
    making.frame.view = seen ? *seen : *framing_;
    making.frame.view.width = options_.width;
    making.frame.view.height = options_.height;
    making.frame.view.samples = options_.samples;
    return {};
}

/// A file without lights gets a sun and a sky; shadows are scaled to the scene. glTF lights are physical and its cameras have
/// no exposure: a lamp of 180 candela a meter away makes paper 57 times as bright as white. Where lights could make a white
/// surface brighter than the film's white, or no brighter than a 64th of it, that becomes its white.
void FrameSource::set_light(Making& making) {
    Frame& frame = making.frame;
    for (const std::string& warning : add_lights(frame, document_, hierarchy_, making.to_world)) warn(warning);
    if (frame.lights.empty() && frame.sun.irradiance == glm::vec3(0)) {
        warn("there are no lights; a sun and a sky are added");
        add_default_light(frame);
    }
    end_lights(frame, making.scene);
    const double radius = making.scene.radius();
    const float bias = static_cast<float>(std::min(0.02, radius * 0.004));
    frame.sun.shadow.bias = bias;
    for (Light& light : frame.lights) light.shadow.bias = bias;
    frame.sun.shadow_distance = static_cast<float>(glm::length(making.scene.center() - frame.view.origin) + radius);
    if (!exposure_) exposure_ = options_.exposure;
    if (!exposure_) {
        const double white = white_radiance(frame, making.scene), film = static_cast<double>(frame.film.white);
        constexpr double darkest = 1. / 64;
        // A light that is not finite is refused as such.
        const bool is_far_off = std::isfinite(white) && white > 0 && (white > film || white < darkest * film);
        constexpr double least = std::numeric_limits<float>::min(), most = std::numeric_limits<float>::max();
        exposure_ = is_far_off ? static_cast<float>(std::clamp(film / white, least, most)) : 1.0f;
        if (is_far_off) {
            warn(fmt::format("the lights make a white surface as bright as {:.3g}; the exposure is {:.3g}", white, *exposure_));
        }
    }
    frame.view.exposure = *exposure_;
}

Result<Frame> FrameSource::frame(std::uint32_t index) {
    if (index > 0 && !exposure_) {  // what stays is taken from frame 0
        if (const auto first = frame(0); !first) return first.error();
    }
    const double fps = options_.fps.value_or(30);
    Making making = begin(index / fps, (index == 0 ? 0 : index - 1) / fps);
    making.frame.time = index / fps;
    making.frame.index = index;
    making.frame.materials = surfaces_.materials;
    making.frame.textures = surfaces_.textures;
    if (const auto drawn = add_draws(making); !drawn) return drawn.error();
    if (const auto seen = set_view(making); !seen) return seen.error();
    set_light(making);
    shorten_names(making.frame);
    if (const auto checked = check_frame(making.frame); !checked) return checked.error();
    return std::move(making.frame);
}

}  // namespace strata::gltf
