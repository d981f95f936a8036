#include "capture_format/import/gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

#include <tiny_gltf.h>

#include "capture_format/import/gltf_materials.h"
#include "capture_format/import/gltf_meshes.h"
#include "capture_format/import/gltf_scene.h"
#include "capture_format/inspection.h"
#include "capture_format/reader.h"

namespace strata {
namespace {

using gltf::Bounds;
using gltf::PlacedNode;

constexpr std::array<std::string_view, 6> supported_extensions = {"KHR_lights_punctual",        "KHR_materials_emissive_strength",
                                                                  "KHR_materials_transmission", "KHR_materials_unlit",
                                                                  "KHR_mesh_quantization",      "KHR_texture_transform"};

bool is_supported(std::string_view extension) {
    return std::find(supported_extensions.begin(), supported_extensions.end(), extension) != supported_extensions.end();
}

/// Keeps the encoded bytes for the texture import. Those of a buffer view may lie outside the buffer and are read there.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                  void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

Result<tinygltf::Model> load(const std::filesystem::path& path) {
    std::array<char, 4> magic{};
    std::ifstream file(path, std::ios::binary);
    if (!file) return fail(Fault::bad_input, "cannot open {}", path.string());
    file.read(magic.data(), magic.size());
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_encoded, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    const bool binary = std::string_view(magic.data(), magic.size()) == "glTF";
    const bool loaded = binary ? loader.LoadBinaryFromFile(&model, &error, &warning, path.string())
                               : loader.LoadASCIIFromFile(&model, &error, &warning, path.string());
    if (!loaded) {
        while (!error.empty() && error.back() == '\n') error.pop_back();
        return fail(Fault::bad_input, "{} is no readable glTF: {}", path.string(), error.empty() ? warning : error);
    }
    return model;
}

/// Builds the frame of one model.
class SceneImport {
public:
    SceneImport(const tinygltf::Model& model, const GltfOptions& options) : model_(model), options_(options) {}

    Result<ImportedScene> run() {
        if (const auto checked = check_extensions(); !checked) return checked.error();
        auto nodes = gltf::place_nodes(model_);
        if (!nodes) return nodes.error();
        gltf::ImportedMaterials materials = gltf::import_materials(model_);
        frame_.materials = std::move(materials.materials);
        frame_.textures = std::move(materials.textures);
        for (const std::string& warning : materials.warnings) warn(warning);
        if (const auto drawn = add_draws(*nodes); !drawn) return drawn.error();
        for (const std::string& warning : gltf::add_lights(frame_, model_, *nodes)) warn(warning);
        if (const auto seen = set_view(*nodes); !seen) return seen.error();
        finish_light();
        set_exposure();
        if (!model_.animations.empty()) warn("animations are ignored; the scene is as the nodes place it");
        shorten_names();
        if (const auto checked = check_frame(frame_); !checked) return checked.error();
        return ImportedScene{std::move(frame_), std::move(warnings_)};
    }

private:
    void warn(std::string sentence) {
        if (std::find(warnings_.begin(), warnings_.end(), sentence) == warnings_.end()) warnings_.push_back(std::move(sentence));
    }

    Result<void> check_extensions() {
        for (const std::string& extension : model_.extensionsRequired) {
            if (!is_supported(extension))
                return fail(Fault::bad_input, "the glTF requires {}, which is not supported", extension);
        }
        for (const std::string& extension : model_.extensionsUsed) {
            if (!is_supported(extension)) warn(fmt::format("{} is ignored", extension));
        }
        return {};
    }

    /// The mesh of a primitive; imported once however many nodes show it.
    Result<std::uint32_t> mesh_of(const tinygltf::Mesh& source, const tinygltf::Primitive& primitive) {
        const auto [known, fresh] = meshes_.try_emplace(&primitive, static_cast<std::uint32_t>(frame_.meshes.size()));
        if (!fresh) return known->second;
        auto imported = gltf::import_primitive(model_, primitive, frame_.materials[material_of(primitive)]);
        if (!imported) return fail(Fault::bad_input, "mesh '{}': {}", source.name, imported.error().sentence);
        for (const std::string& warning : imported->warnings) warn(fmt::format("mesh '{}': {}", source.name, warning));
        if (imported->mesh.indices.empty()) return known->second = no_index;
        Bounds& bounds = bounds_.emplace_back();
        for (const glm::vec3& position : imported->mesh.positions) {
            bounds.low = glm::min(bounds.low, glm::dvec3(position));
            bounds.high = glm::max(bounds.high, glm::dvec3(position));
        }
        imported->mesh.name = source.name;
        frame_.meshes.push_back(std::move(imported->mesh));
        return known->second;
    }

    std::uint32_t material_of(const tinygltf::Primitive& primitive) const {
        const std::size_t count = model_.materials.size();  // the default material lies behind them
        const auto index = static_cast<std::size_t>(primitive.material);
        return static_cast<std::uint32_t>(primitive.material >= 0 && index < count ? index : count);
    }

    Result<void> add_draws(const std::vector<PlacedNode>& nodes) {
        for (const PlacedNode& placed : nodes) {
            if (placed.node->mesh < 0) continue;
            if (static_cast<std::size_t>(placed.node->mesh) >= model_.meshes.size()) {
                return fail(Fault::bad_input, "node '{}' shows mesh {}, which does not exist", placed.node->name,
                            placed.node->mesh);
            }
            if (placed.node->skin >= 0) warn("skins are ignored; meshes stand in their bind pose");
            const double volume = glm::determinant(glm::dmat3(placed.to_world));
            if (volume == 0 || !std::isfinite(volume)) {
                warn(fmt::format("node '{}' is left out: its scale is zero", placed.node->name));
                continue;
            }
            const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(placed.node->mesh)];
            for (const tinygltf::Primitive& primitive : mesh.primitives) {
                const auto index = mesh_of(mesh, primitive);
                if (!index) return index.error();
                if (*index != no_index) add_draw(placed, *index, material_of(primitive));
            }
        }
        return {};
    }

    void add_draw(const PlacedNode& placed, std::uint32_t mesh, std::uint32_t material) {
        Draw draw;
        draw.name = placed.node->name.empty() ? frame_.meshes[mesh].name : placed.node->name;
        draw.mesh = mesh;
        draw.material = material;
        draw.to_world = draw.previous_to_world = placed.to_world;
        frame_.draws.push_back(std::move(draw));
        for (int corner = 0; corner < 8; ++corner) {
            const Bounds& box = bounds_[mesh];
            const glm::dvec4 p((corner & 1) ? box.high.x : box.low.x, (corner & 2) ? box.high.y : box.low.y,
                               (corner & 4) ? box.high.z : box.low.z, 1);
            corners_.emplace_back(placed.to_world * p);
            scene_.low = glm::min(scene_.low, corners_.back());
            scene_.high = glm::max(scene_.high, corners_.back());
        }
    }

    Result<void> set_view(const std::vector<PlacedNode>& nodes) {
        if (options_.camera >= 0 && static_cast<std::size_t>(options_.camera) >= model_.cameras.size()) {
            return fail(Fault::usage, "there is no camera {}; the glTF has {}", options_.camera, model_.cameras.size());
        }
        const double aspect = static_cast<double>(options_.width) / options_.height;
        const int wanted = options_.camera >= 0 ? options_.camera : 0;
        if (corners_.empty()) corners_ = {glm::dvec3(-1), glm::dvec3(1)};
        frame_.view = gltf::framing_view(corners_, scene_, options_);
        if (!model_.cameras.empty()) {
            const auto placed =
                std::find_if(nodes.begin(), nodes.end(), [&](const PlacedNode& node) { return node.node->camera == wanted; });
            if (placed == nodes.end()) {
                warn(fmt::format("camera {} is on no node of the scene; a framing camera is used", wanted));
            } else {
                look_through(model_.cameras[static_cast<std::size_t>(wanted)], placed->to_world, aspect);
            }
        }
        frame_.view.width = options_.width;
        frame_.view.height = options_.height;
        frame_.view.samples = options_.samples;
        return {};
    }

    void look_through(const tinygltf::Camera& camera, const glm::dmat4& to_world, double aspect) {
        const double fov = camera.perspective.yfov, near = camera.perspective.znear;
        const glm::dvec3 forward = -glm::dvec3(to_world[2]), up(to_world[1]);
        if (camera.type != "perspective") return warn("orthographic cameras are not supported; a framing camera is used");
        if (!(fov > 0 && fov < 3.1 && near > 0) || !(glm::length(glm::cross(forward, up)) > 0)) {
            return warn(fmt::format("camera '{}' is degenerate; a framing camera is used", camera.name));
        }
        frame_.view = gltf::look_along(glm::dvec3(to_world[3]), forward, up);
        frame_.view.near = static_cast<float>(near);
        frame_.view.projection = perspective(fov, aspect, near);
    }

    /// A file without lights gets a sun and a sky, so that there is something to see; shadows are scaled to the scene.
    void finish_light() {
        const double radius = scene_.radius();
        if (frame_.lights.empty() && frame_.sun.irradiance == glm::vec3(0)) {
            warn("there are no lights; a sun and a sky are added");
            frame_.sun.direction = glm::normalize(glm::vec3(-0.5f, -1, -0.6f));
            frame_.sun.irradiance = glm::vec3(2.6f, 2.5f, 2.3f);  // a white Lambert surface facing it reflects about 0.8
            frame_.sun.shadow.casts = true;
            frame_.hemisphere = {.sky = glm::vec3(0.45f, 0.5f, 0.6f), .ground = glm::vec3(0.2f, 0.18f, 0.16f)};
            frame_.background = glm::vec3(0.25f, 0.3f, 0.38f);
        }
        const float bias = static_cast<float>(std::min(0.02, radius * 0.004));
        frame_.sun.shadow.bias = bias;
        for (Light& light : frame_.lights) light.shadow.bias = bias;
        frame_.sun.shadow_distance = static_cast<float>(glm::length(scene_.center() - frame_.view.origin) + radius);
    }

    /// glTF lights are physical and its cameras have no exposure: a lamp of 180 candela a metre away makes paper 57 times as
    /// bright as white. Where lights could make a white surface brighter than the film's white, that becomes its white.
    void set_exposure() {
        const double white = gltf::white_radiance(frame_, scene_), film = static_cast<double>(frame_.film.white);
        if (white <= film) return;
        frame_.view.exposure = static_cast<float>(film / white);
        warn(fmt::format("the lights make a white surface as bright as {:.3g}; the exposure is {:.3g}", white,
                         frame_.view.exposure));
    }

    /// Names may be of any length in a glTF, a data URI of a megabyte for one. Cuts never split a UTF-8 character.
    void shorten_names() {
        const auto shorten = [](auto& list) {
            for (auto& item : list) {
                std::size_t length = std::min(item.name.size(), longest_text);
                while (length < item.name.size() && length > 0 && (item.name[length] & 0xc0) == 0x80) --length;
                item.name.resize(length);
            }
        };
        shorten(frame_.textures);
        shorten(frame_.meshes);
        shorten(frame_.materials);
        shorten(frame_.draws);
        shorten(frame_.lights);
    }

    const tinygltf::Model& model_;
    const GltfOptions options_;
    Frame frame_;
    std::vector<std::string> warnings_;
    std::map<const tinygltf::Primitive*, std::uint32_t> meshes_;
    std::vector<Bounds> bounds_;       ///< of each mesh, object space
    std::vector<glm::dvec3> corners_;  ///< of every draw's box, world
    Bounds scene_;
};

}  // namespace

Result<ImportedScene> import_gltf(const std::filesystem::path& path, const GltfOptions& options) {
    if (!(std::abs(options.azimuth) <= 360 && std::abs(options.elevation) < 90)) {
        return fail(Fault::usage, "the framing camera stands at -360 to 360 degrees around and less than 90 above, not at {}, {}",
                    options.azimuth, options.elevation);
    }
    if (options.width == 0 || options.height == 0 || (options.samples != 1 && options.samples != 4)) {
        return fail(Fault::usage, "{} x {} pixels with {} samples cannot be rendered", options.width, options.height,
                    options.samples);
    }
    const auto model = load(path);
    if (!model) return model.error();
    auto scene = SceneImport(*model, options).run();
    if (!scene) return fail(scene.error().fault, "{}: {}", path.string(), scene.error().sentence);
    return scene;
}

}  // namespace strata
