#include "tests/5_techniques/lit_patch.h"

#include "capture_format/view.h"

namespace strata {
namespace {

/// Not far enough to need more than a narrow cone, and not so near that a texel's solid angle varies much.
constexpr float spot_distance = 1.5f;

void add_spot(Frame& frame, float z) {
    Light spot;
    spot.type = LightType::round_spot;
    spot.position = {0, 0, z};
    spot.direction = {0, 0, z > 0 ? -1 : 1};
    spot.inner_angle = .28f;
    spot.outer_angle = .3f;
    spot.intensity = glm::vec3(4000);
    spot.range = 150;
    frame.lights.push_back(spot);
}

}  // namespace

void add_square(Frame& frame, const glm::dvec3& center, double half) {
    Mesh mesh;
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
        mesh.positions.emplace_back(center + glm::dvec3(half * corner, 0));
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Material material;
    material.lighting_model = LightingModel::lambert;
    material.base_color = {1, 1, 1, 1};
    material.double_sided = true;
    frame.draws.push_back({.mesh = std::uint32_t(frame.meshes.size()), .material = std::uint32_t(frame.materials.size())});
    frame.draws.back().casts_shadow = false;
    frame.meshes.push_back(mesh);
    frame.materials.push_back(material);
}

void look(Frame& frame, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov) {
    frame.view = look_at(
        {.eye = eye, .target = target, .vertical_fov = vertical_fov, .width = frame.view.width, .height = frame.view.height});
}

Frame lit_patch(std::uint32_t cells, std::uint32_t width, std::uint32_t height) {
    Frame frame;
    frame.view.width = width;
    frame.view.height = height;
    add_square(frame, glm::dvec3(0), .3);
    frame.draws.back().casts_shadow = true;
    add_spot(frame, spot_distance);
    frame.light_volumes = {
        {.kind = VolumeKind::fixed_local, .half_extent = glm::vec3(.5f * float(cells)), .cells = glm::uvec3(cells)}};
    return frame;
}

void light_from_behind(Frame& frame) { add_spot(frame, -spot_distance); }

}  // namespace strata
