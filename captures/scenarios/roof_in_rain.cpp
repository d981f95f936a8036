// Rain on a bus shelter: what lies under its roof stays dry, and the lower face of the roof. An umbrella is carried past.
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

Material rough(std::string name, glm::vec3 color, float roughness) {
    return {.name = std::move(name), .base_color = glm::vec4(color, 1), .roughness = roughness};
}

void add_box(FrameBuilder& builder, std::uint32_t material, const glm::vec3& half, const Pose& place) {
    builder.draw(builder.add(box(half)), material, place);
}

/// A roof on two posts before a back wall, with a bench under it.
void add_shelter(FrameBuilder& builder) {
    const std::uint32_t plaster = builder.add(rough("plaster", {0.62f, 0.55f, 0.45f}, 0.9f));
    const std::uint32_t wood = builder.add(rough("wood", {0.4f, 0.22f, 0.1f}, 0.75f));
    add_box(builder, plaster, {1.5f, 1.2f, 0.1f}, {.position = {0.2, 1.2, -1.7}});
    add_box(builder, plaster, {1.8f, 0.08f, 1.1f}, {.position = {0.2, 2.48, -0.9}});
    for (const double x : {-1.3, 1.7}) add_box(builder, wood, {0.06f, 1.2f, 0.06f}, {.position = {x, 1.2, 0.05}});
    add_box(builder, wood, {1, 0.04f, 0.2f}, {.position = {0.2, 0.45, -1.35}});
    for (const double x : {-0.6, 1.0}) add_box(builder, wood, {0.05f, 0.21f, 0.15f}, {.position = {x, 0.21, -1.35}});
}

/// What is not porous: water shows by its waves alone.
void add_metals(FrameBuilder& builder) {
    Material steel = rough("steel", {0.6f, 0.6f, 0.62f}, 0.35f);
    steel.metallic = 1;
    builder.draw(builder.add(sphere(0.35f, 32)), builder.add(std::move(steel)), {.position = {2.2, 0.35, 0.9}});
    builder.draw(builder.add(sphere(0.3f, 32)), builder.add(rough("rubber", {0.5f, 0.08f, 0.06f}, 0.85f)),
                 {.position = {-0.5, 0.3, 0.9}});
}

/// Carried over the pavement: dry below while it is there.
void add_umbrella(FrameBuilder& builder) {
    const auto at = [](double progress) { return glm::translate(glm::dmat4(1), glm::dvec3(-1.1 - 0.5 * progress, 2.15, 0.9)); };
    const std::uint32_t cloth = builder.add(rough("cloth", {0.1f, 0.2f, 0.45f}, 0.8f));
    Draw& umbrella = builder.draw(builder.add(box({0.5f, 0.02f, 0.5f})), cloth, {});
    umbrella.to_world = at(builder.progress());
    umbrella.previous_to_world = at(builder.previous_progress());
    umbrella.mobility = Mobility::moving;
}

}  // namespace

Frame roof_in_rain(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {-0.7, 1.75, 4.3}, .target = {0.1, 1.05, -0.6}, .vertical_fov = 0.85, .swing = 0.15});
    add_box(builder, builder.add(rough("pavement", glm::vec3(0.35f), 0.85f)), {12, 0.1f, 12}, {.position = {0, -0.1, -4}});
    add_shelter(builder);
    add_metals(builder);
    add_box(builder, builder.add(rough("brick", {0.45f, 0.18f, 0.12f}, 0.95f)), {0.12f, 1.4f, 2}, {.position = {3.4, 1.4, -0.6}});
    add_umbrella(builder);
    builder.frame.rain = {.intensity = 0.7f, .wetness = 1, .direction = glm::normalize(glm::vec3(0.12f, -1, 0.05f))};
    builder.frame.time += 12.34;
    builder.frame.sun = {.direction = glm::normalize(glm::vec3(-0.45f, -0.5f, 0.6f)), .irradiance = {1.5f, 1.45f, 1.35f}};
    builder.frame.hemisphere = {.sky = {0.55f, 0.6f, 0.68f}, .ground = {0.25f, 0.24f, 0.22f}};
    builder.frame.background = {0.55f, 0.6f, 0.68f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
