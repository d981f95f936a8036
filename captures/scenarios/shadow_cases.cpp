// Receivers and casters for which bounds of a shadow map's texels are easy or hard: a plane, boxes, leaves.
#include <cmath>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/foliage.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

void add_afternoon(Frame& frame, glm::vec3 direction) {
    frame.sun.direction = glm::normalize(direction);
    frame.sun.irradiance = {4.6f, 4.1f, 3.3f};
    frame.sun.shadow = {.casts = true, .map_size = 512};
    frame.sun.cascades = 2;
    frame.sun.shadow_distance = 40;
    frame.hemisphere = {.sky = {0.32f, 0.42f, 0.6f}, .ground = {0.16f, 0.14f, 0.11f}};
    frame.background = {0.5f, 0.65f, 0.9f};
}

/// A matt floor of squares, 2 m wide.
std::uint32_t paving(FrameBuilder& builder, float meters) {
    Material tiles = lambert("paving", glm::vec3(1));
    tiles.base_color_texture.texture = builder.add(checker(2, {0.52f, 0.47f, 0.4f}, {0.38f, 0.33f, 0.28f}));
    tiles.base_color_texture.transform = {meters / 4, 0, 0, 0, meters / 4, 0};
    return builder.add(tiles);
}

}  // namespace

/// A slope that rises to the right and away from the eye, towards the sun: along a row of texels of the shadow map its depth
/// grows evenly, and a tile's nearest and farthest depths lie far apart although the ground is flat.
Frame tilted_ground(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 3.2, 9}, .target = {0, 1.4, -4}, .vertical_fov = 0.8, .swing = 0.15});
    const glm::dvec3 rise{0.28, 0, -0.16};  // meters up per meter; in x and -z
    const auto ground = [&](double x, double z) { return rise.x * x + rise.z * z; };
    const glm::dvec3 right = glm::normalize(glm::dvec3(1, rise.x, 0)), up = glm::normalize(glm::dvec3(-rise.x, 1, -rise.z));
    Draw& slope = builder.draw(builder.add(box({30, 0.2f, 30})), paving(builder, 60), {});
    const glm::dvec3 back = glm::cross(right, up), middle = glm::dvec3(0, ground(0, -14), -14) - 0.2 * up;
    slope.to_world = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(middle, 1));
    slope.previous_to_world = slope.to_world;
    const std::uint32_t post = builder.add(box({0.12f, 1.1f, 0.12f})),
                        stone = builder.add(lambert("stone", {0.62f, 0.56f, 0.5f}));
    for (int i = 0; i < 12; ++i) {
        const double x = i % 2 == 0 ? -2.2 : 2.2, z = 3.5 - 2.4 * (i / 2);
        builder.draw(post, stone, {.position = {x, ground(x, z) + 0.9, z}});
    }
    builder.draw(builder.add(sphere(0.8f, 24)), builder.add(lambert("ball", {0.65f, 0.2f, 0.12f})),
                 {.position = {-0.4, ground(-0.4, -1.5) + 0.7, -1.5}});
    add_afternoon(builder.frame, {-0.8f, -0.7f, 0.35f});
    return std::move(builder.frame);
}

/// Boxes of all sizes and turns, some on others, close enough for their shadows to meet.
Frame thirty_boxes(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.5, 4.6, 10}, .target = {0, 0.6, -1.5}, .vertical_fov = 0.75});
    builder.draw(builder.add(box({30, 0.2f, 30})), paving(builder, 60), {.position = {0, -0.2, -8}});
    const std::uint32_t cube = builder.add(box(glm::vec3(0.5f)));
    const std::uint32_t paints[] = {builder.add(lambert("plaster", {0.66f, 0.6f, 0.52f})),
                                    builder.add(lambert("brick", {0.5f, 0.2f, 0.12f})),
                                    builder.add(lambert("slate", {0.2f, 0.26f, 0.33f}))};
    Random random(builder.seed());
    for (int i = 0; i < 24; ++i) {
        const double column = i % 6 - 2.5, row = i / 6, x = 1.9 * column + random.between(-0.5, 0.5);
        const double z = 3.2 - 2.9 * row + random.between(-0.7, 0.7), width = random.between(0.5, 1.3);
        const double height = random.between(0.4, 2.4), yaw = random.between(0.0, 1.57);
        const std::uint32_t paint = paints[random.below(3)];
        builder.draw(cube, paint, {.position = {x, height / 2, z}, .yaw = yaw, .scale = {width, height, width}});
        if (i % 4 != 1) continue;
        const double above = random.between(0.2, 0.5);
        builder.draw(cube, paints[random.below(3)],
                     {.position = {x, height + above / 2, z}, .yaw = yaw + 0.6, .scale = {0.7 * width, above, 0.7 * width}});
    }
    add_afternoon(builder.frame, {-0.7f, -0.75f, -0.4f});
    return std::move(builder.frame);
}

/// Crowns of masked cards between the sun and everything: hardly a tile of the shadow map lies at one depth, so bounds decide
/// nothing and cost what they cost.
Frame leaves(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.6, 7}, .target = {0, 1.7, -3}, .vertical_fov = 0.85, .swing = 0.12});
    builder.draw(builder.add(box({30, 0.2f, 30})), builder.add(lambert("lawn", {0.2f, 0.26f, 0.09f})),
                 {.position = {0, -0.2, -10}});
    builder.draw(builder.add(box({1.1f, 0.02f, 25})), builder.add(lambert("path", {0.5f, 0.42f, 0.32f})), {});
    const std::uint32_t leaf = builder.add(masked("leaves", builder.add(leaf_spray(builder.seed(), 40, 0.22f))));
    const std::uint32_t crowns = builder.add(crown(builder.seed() + 1, 70, 0.4f)), trunk = builder.add(box(glm::vec3(0.5f)));
    const std::uint32_t bark = builder.add(lambert("bark", {0.2f, 0.13f, 0.08f}));
    for (int i = 0; i < 8; ++i) {
        const double side = i % 2 == 0 ? -1 : 1, z = 3.4 - 2.7 * i, height = 3.0 + 0.5 * std::sin(3.0 * i);
        const glm::dvec3 foot{side * (2.1 + 0.2 * std::cos(2.0 * i)), 0, z};
        builder.draw(trunk, bark,
                     {.position = foot + glm::dvec3(0, height / 2, 0), .yaw = 1.0 * i, .scale = {0.24, height, 0.24}});
        builder.draw(crowns, leaf, {.position = foot + glm::dvec3(0, height, 0), .yaw = 2.0 * i, .scale = glm::dvec3(2.0)});
    }
    const std::uint32_t wood = builder.add(lambert("bench", {0.45f, 0.28f, 0.14f}));
    builder.draw(trunk, wood, {.position = {-1.6, 0.46, 1}, .yaw = 1.5, .scale = {1.8, 0.08, 0.45}});
    for (const double z : {0.3, 1.7}) builder.draw(trunk, wood, {.position = {-1.6, 0.21, z}, .scale = {0.4, 0.42, 0.08}});
    add_afternoon(builder.frame, {-0.45f, -0.85f, 0.3f});
    return std::move(builder.frame);
}

}  // namespace strata::scenario
