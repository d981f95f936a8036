// A hall whose roof has fallen in: the sun comes through tall windows and through the hole, and the dusty air shows its shafts.
//
//   z = -16 +--------------------+    windows on the right side, towards the sun; columns on both sides; the hole in the roof
//           |  o              o  |    lies over the third pair of columns
//           |  o     rubble   o  =
//           |  o              o  =
//           |  o              o  =
//   z = 2   +--------------------+
//         x = -5                 5
#include <cmath>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/modeling.h"
#include "captures/scenarios/painting.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace hall {
namespace {

constexpr float half_width = 5, height = 6.5f, front = 2, back = -16, wall = 0.4f, bay = 3.6f;

std::uint32_t stone(FrameBuilder& builder) {
    Material material = lambert("stone", glm::vec3(1));
    material.base_color_texture.texture = builder.add(painted("stone", {.edge = 128}, [](glm::vec2 uv) {
        const float row = std::floor(uv.y * 4), along = uv.x * 2 + (std::fmod(row, 2.0f) == 0 ? 0 : 0.5f);
        const glm::vec2 within = glm::fract(glm::vec2(along, uv.y * 4)), border = glm::min(within, 1.0f - within);
        const float joint = std::min(border.x * 2, border.y) < 0.03f ? 0.6f : 1.0f;
        const float shade = 0.85f + 0.15f * hashed(std::int64_t(along) % 2, std::int64_t(row), 5) - 0.2f * tiling_noise(uv, 4, 9);
        return glm::vec4(glm::vec3(0.6f, 0.54f, 0.45f) * (shade * joint), 1);
    }));
    material.base_color_texture.transform = {0.4f, 0, 0, 0, 0.4f, 0};
    return builder.add(material);
}

/// The wall at the right with a tall window in each bay, as wide as 1.4 m.
void add_window_wall(Mesh& mesh) {
    constexpr float x = half_width, far_x = half_width + wall, sill = 1.3f, head = 5.2f, half = 0.7f;
    part::box(mesh, {x, 0, back}, {far_x, sill, front});
    part::box(mesh, {x, head, back}, {far_x, height, front});
    float from = front;
    for (int i = 0; i < 5; ++i) {
        const float middle = front - bay * (float(i) + 0.5f);
        part::box(mesh, {x, sill, middle + half}, {far_x, head, from});
        for (const float y : {2.6f, 3.9f})
            part::box(mesh, {x + 0.1f, y - 0.03f, middle - half}, {x + 0.2f, y + 0.03f, middle + half});
        part::box(mesh, {x + 0.1f, sill, middle - 0.03f}, {x + 0.2f, head, middle + 0.03f});
        from = middle - half;
    }
    part::box(mesh, {x, sill, back}, {far_x, head, from});
}

/// All of the roof but a ragged hole.
void add_roof(Mesh& mesh) {
    constexpr float cell = 0.5f;
    for (float z = back; z < front; z += cell)
        for (float x = -half_width; x < half_width; x += cell) {
            const glm::vec2 from_hole((x + cell / 2 + 0.6f) / 2.6f, (z + cell / 2 + 8) / 2.1f);
            const float ragged = 0.35f * hashed(std::int64_t(x * 2), std::int64_t(z * 2), 3);
            if (glm::length(from_hole) + ragged > 1.15f) part::box(mesh, {x, height, z}, {x + cell, height + 0.25f, z + cell});
        }
    for (float z = front - bay; z > back; z -= bay)
        part::beam(mesh, {-half_width, 6.2f, z}, {half_width, 6.2f, z}, {0.15f, 0.3f});
}

void add_columns(Mesh& mesh) {
    constexpr glm::vec2 profile[] = {{0.5f, 6.2f},  {0.5f, 6.0f},  {0.36f, 5.75f}, {0.4f, 5.65f}, {0.34f, 5.6f},
                                     {0.38f, 0.5f}, {0.48f, 0.4f}, {0.48f, 0.25f}, {0.55f, 0.2f}, {0.55f, 0.0f}};
    for (float z = front - bay; z > back; z -= bay)
        for (const float x : {-3.4f, 3.4f}) part::turned(mesh, profile, {x, 0, z}, 20);
}

void add_rubble(FrameBuilder& builder, std::uint32_t material) {
    const std::uint32_t block = builder.add(box(glm::vec3(0.5f)));
    Random random(builder.seed());
    for (int i = 0; i < 40; ++i) {
        const double angle = random.between(0.0, 6.28), radius = 2.2 * std::sqrt(random.unit()), size = random.between(0.15, 0.6);
        const double pile = 0.5 * std::max(0.0, 1 - radius / 1.8), yaw = random.between(0.0, 1.6);
        builder.draw(block, material,
                     {.position = {-0.6 + radius * std::cos(angle), pile + 0.3 * size, -8 + 0.8 * radius * std::sin(angle)},
                      .yaw = yaw,
                      .scale = {size, 0.6 * size, 0.8 * size}});
    }
}

/// Everything of stone.
void add_masonry(FrameBuilder& builder) {
    const std::uint32_t masonry = stone(builder);
    Mesh walls;
    walls.name = "hall";
    part::box(walls, {-half_width - wall, -0.3f, back - wall}, {half_width + wall, 0, front + wall});
    part::box(walls, {-half_width - wall, 0, back}, {-half_width, height, front});
    for (const float z : {back - wall, front})
        part::box(walls, {-half_width - wall, 0, z}, {half_width + wall, height, z + wall});
    add_window_wall(walls);
    add_roof(walls);
    builder.draw(builder.add(std::move(walls)), masonry, {});
    Mesh columns;
    columns.name = "columns";
    add_columns(columns);
    builder.draw(builder.add(std::move(columns)), masonry, {});
    add_rubble(builder, masonry);
}

}  // namespace
}  // namespace hall

Frame hall_with_shafts(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {-0.9, 1.7, 1.4}, .target = {0.7, 2.6, -9}, .vertical_fov = 0.95, .swing = 0.1});
    hall::add_masonry(builder);
    Sun& sun = builder.frame.sun;
    sun.direction = glm::normalize(glm::vec3(-0.75f, -0.85f, -0.22f));
    sun.irradiance = {11, 9.4f, 7};
    sun.shadow = {.casts = true, .map_size = 512};
    sun.cascades = 2;
    sun.shadow_distance = 24;
    sun.shafts = true;
    builder.frame.fog = {.density = 0.03f, .color = {0.2f, 0.19f, 0.18f}};
    builder.frame.hemisphere = {.sky = {0.14f, 0.16f, 0.19f}, .ground = {0.12f, 0.1f, 0.08f}};
    builder.frame.background = {0.7f, 0.85f, 1.1f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
