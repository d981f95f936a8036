#include "capture_format/export/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "capture_format/container/whole_file.h"
#include "capture_format/export/gltf_losses.h"
#include "capture_format/export/gltf_parts.h"
#include "capture_format/export/gltf_surfaces.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/light_types.h"
#include "capture_format/out_of_memory.h"

namespace strata {
namespace {

using to_gltf_parts::Json;
using to_gltf_parts::Parts;

template <int n>
std::span<const float> floats(const std::vector<glm::vec<n, float>>& vectors) {
    return {reinterpret_cast<const float*>(vectors.data()), vectors.size() * n};
}

Json column_major(const glm::dmat4& matrix) {
    Json numbers = Json::array();
    for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
    return numbers;
}

/// A node's transform that looks along -z of its own, as glTF's lights and cameras do.
glm::dmat4 looking(const glm::dvec3& position, glm::dvec3 forward) {
    forward = glm::normalize(forward);
    const glm::dvec3 up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    return {glm::dvec4(right, 0), glm::dvec4(glm::cross(right, forward), 0), glm::dvec4(-forward, 0), glm::dvec4(position, 1)};
}

/// Writes one frame.
class SceneExport {
public:
    explicit SceneExport(const Frame& frame) : frame_(frame) {}

    ExportedScene run() {
        to_gltf_parts::Surfaces surfaces(frame_, parts_);
        surfaces.add_materials();
        for (const Draw& draw : frame_.draws) {
            add_node({{"name", draw.name}, {"mesh", mesh(draw)}, {"matrix", column_major(draw.to_world)}});
        }
        add_camera();
        add_lights();
        parts_.add("scenes", {{"nodes", roots_}});
        parts_.root["scene"] = 0;
        if (!parts_.binary.empty()) parts_.add("buffers", {{"byteLength", parts_.binary.size()}});
        std::vector<std::string> warnings = to_gltf_parts::losses(frame_);
        warnings.insert(warnings.end(), surfaces.warnings().begin(), surfaces.warnings().end());
        if (parts_.not_finite > 0) {
            warnings.push_back(fmt::format("{} numbers of meshes are not finite; 0 is written instead", parts_.not_finite));
        }
        return {glb(), std::move(warnings)};
    }

private:
    void add_node(Json node) { roots_.push_back(parts_.add("nodes", std::move(node))); }

    /// The streams of a mesh as accessors, once however many draws show it.
    const Json& primitive(std::uint32_t index) {
        const auto [known, fresh] = primitives_.try_emplace(index);
        if (!fresh) return known->second;
        const Mesh& mesh = frame_.meshes[index];
        Json attributes = {{"POSITION", parts_.add_floats(floats(mesh.positions), "VEC3", 3)}};
        if (!mesh.normals.empty()) attributes["NORMAL"] = parts_.add_floats(floats(mesh.normals), "VEC3", 3);
        if (!mesh.tangents.empty()) attributes["TANGENT"] = parts_.add_floats(floats(mesh.tangents), "VEC4", 4);
        if (!mesh.uv0.empty()) attributes["TEXCOORD_0"] = parts_.add_floats(floats(mesh.uv0), "VEC2", 2);
        if (!mesh.uv1.empty()) attributes["TEXCOORD_1"] = parts_.add_floats(floats(mesh.uv1), "VEC2", 2);
        if (!mesh.colors.empty()) attributes["COLOR_0"] = parts_.add_floats(floats(mesh.colors), "VEC4", 4);
        known->second = {{"attributes", std::move(attributes)}, {"indices", parts_.add_indices(mesh.indices)}};
        return known->second;
    }

    /// A glTF mesh has its material in it, so there is one for every pair.
    std::size_t mesh(const Draw& draw) {
        const auto [known, fresh] = meshes_.try_emplace({draw.mesh, draw.material}, 0);
        if (!fresh) return known->second;
        Json shown = primitive(draw.mesh);
        shown["material"] = draw.material;
        known->second =
            parts_.add("meshes", {{"name", frame_.meshes[draw.mesh].name}, {"primitives", Json::array({std::move(shown)})}});
        return known->second;
    }

    void add_camera() {
        const View& view = frame_.view;
        const double scale_x = std::abs(static_cast<double>(view.projection[0][0])),
                     scale_y = std::abs(static_cast<double>(view.projection[1][1]));
        if (!(scale_x > 0 && scale_y > 0)) return;
        const glm::dmat3 axes = glm::transpose(view.to_view);  // right, up, forward in the world
        const glm::dmat4 to_world(glm::dvec4(axes[0], 0), glm::dvec4(axes[1], 0), glm::dvec4(-axes[2], 0),
                                  glm::dvec4(view.origin, 1));
        Json perspective = {{"yfov", 2 * std::atan(1 / scale_y)}, {"aspectRatio", scale_y / scale_x}, {"znear", view.near}};
        const std::size_t camera = parts_.add("cameras", {{"type", "perspective"}, {"perspective", std::move(perspective)}});
        add_node({{"name", "camera"}, {"camera", camera}, {"matrix", column_major(to_world)}});
    }

    void add_light(Json light, const glm::dvec3& intensity, const glm::dmat4& to_world) {
        const double brightest = std::max({intensity.x, intensity.y, intensity.z});
        const glm::dvec3 color = brightest > 0 ? intensity / brightest : glm::dvec3(1);
        light.update({{"color", {color.x, color.y, color.z}}, {"intensity", brightest}});
        parts_.use("KHR_lights_punctual");
        Json& lights = parts_.root["extensions"]["KHR_lights_punctual"]["lights"];
        Json node = {{"name", light["name"]},
                     {"matrix", column_major(to_world)},
                     {"extensions", {{"KHR_lights_punctual", {{"light", lights.size()}}}}}};
        lights.push_back(std::move(light));
        add_node(std::move(node));
    }

    void add_lights() {
        if (frame_.sun.irradiance != glm::vec3(0)) {
            add_light({{"name", "sun"}, {"type", "directional"}}, glm::dvec3(frame_.sun.irradiance),
                      looking(glm::dvec3(0), glm::dvec3(frame_.sun.direction)));
        }
        for (const Light& light : frame_.lights) {
            if (!to_gltf_parts::is_punctual(light)) continue;
            Json json = {{"name", light.name}, {"type", "point"}};
            if (!has_range(light.type)) json["type"] = "directional";
            if (has_range(light.type)) json["range"] = light.range;
            if (is_spot(light.type)) {
                json["type"] = "spot";
                json["spot"] = {{"innerConeAngle", light.inner_angle}, {"outerConeAngle", light.outer_angle}};
            }
            add_light(std::move(json), glm::dvec3(light.intensity), looking(light.position, glm::dvec3(light.direction)));
        }
    }

    /// Header, JSON padded with spaces, bytes padded with zeros (glTF 2.0, 4.4).
    std::vector<std::byte> glb() const {
        std::string json = parts_.root.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::vector<std::byte> file;
        const auto append = [&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); };
        const auto word = [&](std::size_t value) {
            const auto narrow = static_cast<std::uint32_t>(value);
            append(std::as_bytes(std::span(&narrow, 1)));
        };
        constexpr std::size_t magic = 0x46546c67, version = 2, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
        const std::size_t binary = parts_.binary.size();
        word(magic);
        word(version);
        word(12 + 8 + json.size() + (binary > 0 ? 8 + binary : 0));
        word(json.size());
        word(json_chunk);
        append(std::as_bytes(std::span(json)));
        if (binary == 0) return file;
        word(binary);
        word(binary_chunk);
        append(parts_.binary);
        return file;
    }

    const Frame& frame_;
    Parts parts_;
    std::vector<std::size_t> roots_;
    std::map<std::uint32_t, Json> primitives_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> meshes_;  ///< by mesh and material
};

}  // namespace

Result<ExportedScene> to_gltf(const Frame& frame) {
    return within_memory("export", "the frame", [&]() -> Result<ExportedScene> {
        ExportedScene scene = SceneExport(frame).run();
        if (scene.glb.size() > 0xffffffffu) {
            return fail(Fault::usage, "export.gltf.too_large",
                        "the frame takes {bytes} bytes as glTF; a .glb holds at most 4 GiB", scene.glb.size());
        }
        return scene;
    });
}

Result<std::vector<std::string>> export_gltf(const Frame& frame, const std::filesystem::path& path) {
    auto scene = to_gltf(frame);
    if (!scene) return scene.error();
    return within_memory("write", path.native(), [&]() -> Result<std::vector<std::string>> {
        if (const auto written = write_whole_file(path, scene->glb); !written) return written.error();
        return std::move(scene->warnings);
    });
}

}  // namespace strata
