// A paper sculpture: sheets that pass through each other and through the floor. No triangle ends where two sheets cross, so no
// side of a triangle tells of it, and both sheets take the light differently there.
#include <array>
#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

constexpr double middle = 1.05;  // height of the sculpture's middle, meters

Material sheet(std::string name, glm::vec3 color) {
    Material material = lambert(std::move(name), color);
    material.double_sided = true;
    return material;
}

/// Three upright sheets around one axis, like the wings of a revolving door that goes on behind it.
void add_wings(FrameBuilder& builder) {
    const std::uint32_t wing = builder.add(quad({1.15f, 1.2f}));
    constexpr std::array<glm::vec3, 3> colors = {glm::vec3(0.8f, 0.2f, 0.1f), {0.85f, 0.8f, 0.7f}, {0.05f, 0.35f, 0.4f}};
    constexpr std::array<const char*, 3> names = {"vermilion", "ivory", "teal"};
    for (std::size_t i = 0; i < colors.size(); ++i)
        builder.draw(wing, builder.add(sheet(names[i], colors[i])),
                     {.position = {0, middle, 0}, .yaw = 0.35 + double(i) * std::numbers::pi / 3});
}

/// A sheet that leans through all wings and through the floor, and one that lies across them.
void add_slanted_sheets(FrameBuilder& builder) {
    const std::uint32_t square = builder.add(quad({0.8f, 0.8f}));
    const auto lean = [](glm::dvec3 position, double angle, glm::dvec3 axis) {
        return glm::rotate(glm::translate(glm::dmat4(1), position), angle, glm::normalize(axis));
    };
    Draw& ochre = builder.draw(square, builder.add(sheet("ochre", {0.75f, 0.5f, 0.12f})), {});
    ochre.to_world = ochre.previous_to_world = lean({0.1, middle + 0.1, 0.1}, 1.25, {1, 0.1, 0.25});
    Draw& slate = builder.draw(square, builder.add(sheet("slate", {0.25f, 0.28f, 0.35f})), {});
    slate.to_world = slate.previous_to_world = lean({0.95, 0.35, 0.55}, 0.8, {-0.5, 0.4, 1});
}

}  // namespace

Frame crossing_planes(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {1.1, 2.1, 4.1}, .target = {0.1, 0.85, 0}, .swing = 0.2});
    builder.draw(builder.add(box({4, 0.1f, 3})), builder.add(lambert("floor", {0.45f, 0.42f, 0.4f})),
                 {.position = {0, -0.1, -0.5}});
    add_wings(builder);
    add_slanted_sheets(builder);
    builder.draw(builder.add(sphere(0.35f, 24)), builder.add(lambert("chalk", glm::vec3(0.8f))), {.position = {-1.3, 0.12, 0.9}});
    Light spot;
    spot.name = "window";
    spot.type = LightType::round_spot;
    spot.position = {-2.6, 3.4, 2.6};
    spot.direction = glm::normalize(glm::vec3(2.6f, -2.6f, -2.6f));
    spot.axis_u = glm::normalize(glm::cross(spot.direction, glm::vec3(0, 1, 0)));
    spot.intensity = glm::vec3(1, 0.88f, 0.7f) * 70.f;
    spot.range = 12;
    spot.inner_angle = 0.35f;
    spot.outer_angle = 0.55f;
    spot.shadow = {.casts = true, .map_size = 512};
    Light sky;
    sky.name = "north light";
    sky.position = {3, 2.4, 1.5};
    sky.intensity = glm::vec3(0.3f, 0.5f, 0.8f) * 7.f;
    builder.frame.lights = {spot, sky};
    builder.frame.hemisphere = {.sky = {0.16f, 0.18f, 0.22f}, .ground = {0.08f, 0.07f, 0.06f}};
    builder.frame.background = {0.02f, 0.022f, 0.03f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
