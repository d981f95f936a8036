// Surfaces on which layouts of a G-buffer fail: normals where their packings are singular, and depths of every size.
#include <array>
#include <cmath>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

/// A direction in view space (z forward), and how far normals of its patch turn away from it, in x and y.
struct Patch {
    glm::vec3 normal;
    glm::vec2 spread;
};

constexpr float root_half = 0.70710678f, root_third = 0.57735027f, little = 0.04f;
// Seen edge-on, a normal has z just before 0: its patch reaches from there to twice as far.
constexpr auto patches = std::to_array<Patch>({
    {{0, 0, -1}, glm::vec2(little)},
    {{1, 0, -little}, glm::vec2(little)},
    {{-1, 0, -little}, glm::vec2(little)},
    {{0, 1, -little}, glm::vec2(little)},
    {{0, -1, -little}, glm::vec2(little)},
    {{root_half, root_half, -little}, glm::vec2(little)},
    {{-root_half, root_half, -little}, glm::vec2(little)},
    {{root_half, -root_half, -little}, glm::vec2(little)},
    // Upright walls: y of every normal is exactly 0.
    {{0.6f, 0, -0.8f}, {little, 0}},
    {{-0.6f, 0, -0.8f}, {little, 0}},
    {{0.9f, 0, -0.436f}, {little, 0}},
    {{0, 0.6f, -0.8f}, {0, little}},
    // The corners of the octahedron's faces.
    {{root_third, root_third, -root_third}, glm::vec2(little)},
    {{-root_third, root_third, -root_third}, glm::vec2(little)},
    {{root_third, -root_third, -root_third}, glm::vec2(little)},
    {{-root_third, -root_third, -root_third}, glm::vec2(little)},
});

/// A square that faces the eye, of which the normals say otherwise.
Mesh patch_mesh(const Patch& patch) {
    Mesh mesh = quad(glm::vec2(0.46f));
    mesh.name = "patch";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec2 corner = glm::sign(glm::vec2(mesh.positions[i]));
        const glm::vec3 inward = patch.normal + glm::vec3(corner * patch.spread, 0.9f * little * corner.x);
        mesh.normals[i] = glm::normalize(glm::vec3(inward.x, inward.y, -inward.z));  // the world's z points at the eye
        const glm::vec3 across = std::abs(mesh.normals[i].y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        mesh.tangents[i] = glm::vec4(glm::normalize(glm::cross(across, mesh.normals[i])), 1);
    }
    return mesh;
}

}  // namespace

Frame sixteen_normals(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 5}, .target = {0, 0, 0}});
    for (std::size_t i = 0; i < patches.size(); ++i) {
        Material material = lambert("patch", {0.6f, 0.5f, 0.4f});
        material.lighting_model = LightingModel::ggx;
        material.roughness = 0.25f;
        const double column = double(i % 4) - 1.5, row = 1.5 - double(i / 4);
        builder.draw(builder.add(patch_mesh(patches[i])), builder.add(material), {.position = {column, row, 0}});
    }
    Light lamp;
    lamp.name = "lamp";
    lamp.position = {-2, 2, 4};
    lamp.intensity = glm::vec3(40);
    lamp.range = 20;
    builder.frame.lights.push_back(lamp);
    lamp.name = "lamp on the right";
    lamp.position = {5, -1, 1};
    builder.frame.lights.push_back(lamp);
    builder.frame.hemisphere = {.sky = glm::vec3(0.25f), .ground = glm::vec3(0.12f)};
    return std::move(builder.frame);
}

/// Six panels turned away from the eye, each as large as its distance makes it small; floor and sky wall join them.
Frame far_wall(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.6, 0}, .target = {0, 1.6, -10}, .vertical_fov = 0.8, .swing = 0.05});
    constexpr auto distances = std::to_array<double>({1, 5, 25, 100, 500, 2000});
    const std::uint32_t panel = builder.add(quad({0.5f, 0.5f}));
    for (std::size_t i = 0; i < distances.size(); ++i) {
        Material material = lambert("panel", glm::vec3(0.7f) - glm::vec3(0.1f * float(i % 2)));
        material.lighting_model = LightingModel::ggx;
        material.roughness = 0.4f;
        const double z = distances[i], side = 0.22 * (double(i) - 2.5);
        builder.draw(panel, builder.add(material),
                     {.position = {side * z, 1.6 + 0.12 * z, -z}, .yaw = i % 2 == 0 ? 1.0 : -1.0, .scale = glm::dvec3(0.36 * z)});
    }
    builder.draw(builder.add(box({2500, 0.05f, 2500})), builder.add(lambert("floor", {0.35f, 0.33f, 0.3f})),
                 {.position = {0, -0.05, 0}});
    builder.frame.sun.direction = glm::normalize(glm::vec3(0.4f, -0.7f, -0.6f));
    builder.frame.sun.irradiance = {2.4f, 2.2f, 1.9f};
    builder.frame.hemisphere = {.sky = {0.3f, 0.4f, 0.55f}, .ground = glm::vec3(0.15f)};
    builder.frame.fog = {.density = 1.0f / 1500, .color = {0.55f, 0.65f, 0.8f}};
    builder.frame.background = {0.55f, 0.65f, 0.8f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
