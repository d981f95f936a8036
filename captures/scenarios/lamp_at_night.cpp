// A lamp in a dark street, seen by a camera: it glows, a post before it and lights behind it are out of focus.
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

void add_box(FrameBuilder& builder, std::uint32_t material, const glm::vec3& half, const Pose& place) {
    builder.draw(builder.add(box(half)), material, place);
}

void add_bulb(FrameBuilder& builder, const glm::dvec3& center, float radius, const glm::vec3& radiance) {
    Material bulb = lambert("bulb", glm::vec3(0));
    bulb.emissive = radiance;
    builder.draw(builder.add(sphere(radius, 24)), builder.add(std::move(bulb)), {.position = center}).casts_shadow = false;
}

void add_far_lights(FrameBuilder& builder) {
    const glm::vec3 colors[] = {{9, 4, 1}, {2, 5, 9}, {8, 1, 1}, {3, 8, 3}, {9, 7, 3}, {6, 2, 7}};
    for (int i = 0; i < 6; ++i) add_bulb(builder, {-7 + 2.9 * i, 1.6 + .7 * (i % 3), -14 - 3. * ((2 * i) % 5)}, 0.16f, colors[i]);
}

}  // namespace

/// Focused on the lamp, 2.6 m away, with an aperture as wide as blur must be to show in 64 x 36 pixels.
Frame lamp_at_night(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.2, 0}, .target = {0, 1.1, -2.6}, .vertical_fov = 0.85, .swing = 0.1});
    const std::uint32_t stone = builder.add(lambert("stone", glm::vec3(0.5f))),
                        iron = builder.add(lambert("iron", {.1f, .12f, .16f}));
    add_box(builder, stone, {20, 0.1f, 20}, {.position = {0, -0.1, -15}});
    add_box(builder, iron, {0.03f, 0.65f, 0.03f}, {.position = {0.35, 0.65, -2.6}});
    add_box(builder, stone, {0.25f, 0.25f, 0.25f}, {.position = {-0.45, 0.25, -2.5}, .yaw = 0.4});
    add_box(builder, stone, {1.2f, 1.1f, 0.5f}, {.position = {-2.2, 1.1, -6}, .yaw = 0.3});
    add_box(builder, iron, {0.03f, 1.5f, 0.03f}, {.position = {-0.3, 1.2, -0.9}});
    add_bulb(builder, {0.35, 1.4, -2.6}, 0.1f, {40, 26, 12});
    add_far_lights(builder);
    builder.frame.lights.push_back(
        {.name = "lamp", .position = {0.35, 1.4, -2.45}, .intensity = {2.4f, 1.6f, 0.7f}, .range = 14});
    builder.frame.hemisphere = {.sky = {.02f, .025f, .04f}, .ground = {.01f, .01f, .01f}};
    builder.frame.background = {.012f, .016f, .03f};
    builder.frame.lens = {.bloom = 0.15f,
                          .bloom_threshold = 1,
                          .auto_exposure = true,
                          .exposure_speed = 2,
                          .focus_distance = 2.6f,
                          .aperture = 0.25f,
                          .distortion = true};
    builder.frame.film = {.grain = 0.12f, .fade = 0.05f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
