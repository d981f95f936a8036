// The street of the night market: paving, houses, the lit room, signs and cables.
//
//   z = -22   +===============+    end house
//             |               |
//   z = -12.6 +-----+         |
//             | room    |     |    the open door faces the eye
//   z = -9    +-----[ ]-+     |
//             |               |    left wall x = -2.6, right wall x = 2.6
//   z = 0     |     eye       |
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "captures/scenarios/modeling.h"
#include "captures/scenarios/night_market/night_market.h"
#include "captures/scenarios/parts.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario::market {
namespace {

constexpr float side = 2.6f;                                                // walls of the street, +-x
constexpr float door_left = -0.95f, door_right = 0.05f, door_head = 2.15f;  // in the front of the house at the left
constexpr float house_front = -9, house_right = 0.35f, room_back = -12.4f, room_left = -3.4f, room_height = 2.75f;

/// A window in a wall at x, which faces the street; `towards` is the direction to the street along x.
struct Window {
    float x, towards, z, sill;
    bool lit = false;
};

void add_window(Parts& parts, const Materials& materials, const Window& window) {
    constexpr float half = 0.5f, tall = 1.3f, proud = 0.05f;
    const auto block = [&](std::uint32_t material, glm::vec3 low, glm::vec3 high) {  // x: out of the wall
        const float a = window.x + window.towards * low.x, b = window.x + window.towards * high.x;
        part::box(parts.of(material), {std::min(a, b), window.sill + low.y, window.z + low.z},
                  {std::max(a, b), window.sill + high.y, window.z + high.z});
    };
    block(materials.planks, {0, 0, -half - 0.08f}, {proud, tall, -half});
    block(materials.planks, {0, 0, half}, {proud, tall, half + 0.08f});
    block(materials.kerb, {0, tall, -half - 0.15f}, {0.09f, tall + 0.14f, half + 0.15f});
    block(materials.kerb, {0, -0.1f, -half - 0.15f}, {0.14f, 0, half + 0.15f});
    const float face = window.x + window.towards * 0.012f, s = window.towards;
    Mesh pane;  // its texture covers it once
    part::quad(pane, {glm::vec3(face, window.sill, window.z + s * half),
                      {face, window.sill, window.z - s * half},
                      {face, window.sill + tall, window.z - s * half},
                      {face, window.sill + tall, window.z + s * half}});
    pane.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    Mesh& all = parts.of(window.lit ? materials.lit_window : materials.dark_window);
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (std::size_t i = 0; i < 4; ++i) {
        all.positions.push_back(pane.positions[i]);
        all.normals.push_back(pane.normals[i]);
        all.tangents.push_back(pane.tangents[i]);
        all.uv0.push_back(pane.uv0[i]);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) all.indices.push_back(first + corner);
    if (window.lit) return;
    for (const float open : {-1.0f, 1.0f})  // shutters
        block(materials.boards, {0.02f, 0, open > 0 ? half + 0.1f : -half - 0.6f},
              {0.06f, tall, open > 0 ? half + 0.6f : -half - 0.1f});
}

void add_ground(Parts& parts, const Materials& materials) {
    part::box(parts.of(materials.setts), {-12, -0.3f, -40}, {12, 0, 6});
    part::box(parts.of(materials.kerb), {-side, 0, house_front}, {-side + 0.55f, 0.09f, 5});
    part::box(parts.of(materials.kerb), {side - 0.55f, 0, -22}, {side, 0.09f, 5});
}

void add_walls(Parts& parts, const Materials& materials) {
    Mesh &brick = parts.of(materials.brick), &plaster = parts.of(materials.plaster), &kerb = parts.of(materials.kerb);
    part::box(plaster, {-5, 0, -4.4f}, {-side, 7.2f, 6});
    part::box(brick, {-5, 0, house_front}, {-side, 6.2f, -4.4f});
    part::box(brick, {side, 0, -7.6f}, {5, 7.6f, 6});
    part::box(plaster, {side, 0, -13.5f}, {5, 5.8f, -7.6f});
    part::box(brick, {side, 0, -22}, {5, 7.4f, -13.5f});
    part::box(brick, {-6, 0, -23}, {6, 5.2f, -22});
    part::box(plaster, {-6, 0, -22}, {-0.9f, 5.4f, -12.6f});
    for (const float y : {3.25f, 7.6f}) part::box(kerb, {side - 0.08f, y, -7.6f}, {side, y + 0.16f, 6});
    for (const float y : {3.0f, 5.8f}) part::box(kerb, {side - 0.1f, y, -13.5f}, {side, y + 0.14f, -7.6f});
    part::box(kerb, {-side, 3.1f, house_front}, {-side + 0.08f, 3.25f, -4.4f});
    part::box(kerb, {-side, 3.3f, -4.4f}, {-side + 0.1f, 3.5f, 6});
    part::box(parts.of(materials.boards), {-6.2f, 5.2f, -23.2f}, {6.2f, 5.5f, -21.7f});
}

void add_windows(Parts& parts, const Materials& materials) {
    for (const Window& window : {Window{-side, 1, -6.2f, 4.0f, true},
                                 {-side, 1, -8.6f, 4.0f},
                                 {-side, 1, -2.6f, 4.2f},
                                 {side, -1, -3.2f, 4.1f},
                                 {side, -1, -5.9f, 4.1f, true},
                                 {side, -1, -9.2f, 3.6f},
                                 {side, -1, -11.9f, 3.6f, true},
                                 {side, -1, -15.4f, 4.0f, true},
                                 {side, -1, -18.6f, 4.0f}})
        add_window(parts, materials, window);
    for (const float x : {0.3f, 1.5f})  // of the end house
        part::box(parts.of(materials.lit_window), {x - 0.35f, 2.9f, -22.02f}, {x + 0.35f, 3.9f, -21.98f});
}

/// What hangs on walls: rain pipes, machines that cool the rooms behind.
void add_fittings(Parts& parts, const Materials& materials) {
    Mesh& iron = parts.of(materials.iron);
    for (const glm::vec3 foot : {glm::vec3(-side + 0.1f, 0.1f, -5.0f), {side - 0.1f, 0.1f, -7.9f}, {-side + 0.1f, 0.1f, -1.7f}}) {
        const glm::vec3 line[] = {foot + glm::vec3(0, 0, 0.25f), foot + glm::vec3(0, 0.2f, 0), foot + glm::vec3(0, 6.4f, 0)};
        part::pipe(iron, line, 0.055f, 10);
    }
    for (const glm::vec3 at : {glm::vec3(side - 0.4f, 3.0f, -4.6f), {side - 0.4f, 2.6f, -13.2f}, {-side, 2.9f, -7.3f}}) {
        part::box(parts.of(materials.ceramic), at, at + glm::vec3(0.4f, 0.55f, 0.75f));
        for (int i = 0; i < 6; ++i) {
            const float z = at.z + 0.08f + 0.11f * float(i);
            part::box(iron, {at.x - 0.01f, at.y + 0.06f, z}, {at.x + 0.41f, at.y + 0.48f, z + 0.05f});
        }
    }
}

/// A door, posters and a lamp on the wall at the right of the eye.
void add_right_wall(FrameBuilder& builder, Parts& parts, const Materials& materials, Lamps& lamps) {
    const auto block = [&](std::uint32_t material, glm::vec3 low, glm::vec3 high) {  // x: out of the wall
        part::box(parts.of(material), {side - high.x, low.y, low.z}, {side - low.x, high.y, high.z});
    };
    block(materials.planks, {0, 0.09f, -3.9f}, {0.05f, 2.15f, -3.0f});
    for (const float z : {-4.02f, -3.0f}) block(materials.kerb, {0, 0, z}, {0.12f, 2.27f, z + 0.12f});
    block(materials.kerb, {0, 2.15f, -4.02f}, {0.12f, 2.27f, -2.88f});
    for (const float y : {0.5f, 1.8f}) block(materials.iron, {0.05f, y, -3.85f}, {0.06f, y + 0.06f, -3.05f});
    block(materials.dough, {0, 1.25f, -2.6f}, {0.008f, 1.85f, -2.2f});
    block(materials.coat, {0, 1.45f, -2.12f}, {0.008f, 1.95f, -1.78f});
    block(materials.red_nylon, {0.008f, 1.6f, -2.55f}, {0.01f, 1.78f, -2.25f});
    block(materials.boards, {0.0f, 0.09f, -2.75f}, {0.5f, 0.5f, -2.1f});
    block(materials.planks, {0.05f, 0.5f, -2.65f}, {0.45f, 0.85f, -2.15f});
    constexpr glm::vec2 shade[] = {{0.02f, 0.14f}, {0.05f, 0.12f}, {0.15f, 0.0f}};
    part::turned(parts.of(materials.iron), shade, {side - 0.3f, 2.5f, -3.45f}, 16);
    const glm::vec3 arm[] = {{side, 2.75f, -3.45f}, {side - 0.2f, 2.8f, -3.45f}, {side - 0.3f, 2.62f, -3.45f}};
    part::pipe(parts.of(materials.iron), arm, 0.012f, 6);
    constexpr glm::dvec3 bulb{side - 0.3, 2.5, -3.45};
    builder.draw(builder.add(sphere(0.04f, 10)), materials.warm_bulb, {.position = bulb}).casts_shadow = false;
    Light& lamp = lamps.spot("lamp over the door", bulb, {0, -1, 0}, {5, 3.4f, 1.7f});
    lamp.inner_angle = 0.5f;
    lamp.outer_angle = 1.2f;
    lamp.range = 4.5f;
}

/// The house that stands into the street, with its door open.
void add_house(Parts& parts, const Materials& materials) {
    Mesh &plaster = parts.of(materials.plaster), &brick = parts.of(materials.brick), &planks = parts.of(materials.planks);
    constexpr float inner = house_front - 0.3f, top = 5;
    part::box(brick, {-side - 2, 0, inner}, {door_left, top, house_front});
    part::box(brick, {door_right, 0, inner}, {house_right, top, house_front});
    part::box(brick, {door_left, door_head, inner}, {door_right, top, house_front});
    part::box(brick, {house_right - 0.3f, 0, -12.6f}, {house_right, top, inner});
    part::box(plaster, {room_left - 0.2f, 0, -12.6f}, {house_right - 0.3f, room_height, room_back});
    part::box(plaster, {room_left - 0.2f, 0, room_back}, {room_left, room_height, inner});
    part::box(planks, {room_left, room_height, room_back}, {house_right - 0.3f, room_height + 0.2f, inner});
    part::box(planks, {room_left, 0.001f, room_back}, {house_right - 0.3f, 0.02f, inner});
    part::box(parts.of(materials.boards), {-side - 2, top, -12.8f}, {house_right + 0.25f, top + 0.3f, house_front + 0.3f});
    for (const float x : {door_left - 0.1f, door_right})
        part::box(parts.of(materials.kerb), {x, 0, house_front}, {x + 0.1f, door_head + 0.1f, house_front + 0.06f});
    part::box(parts.of(materials.kerb), {door_left - 0.2f, 0, house_front}, {door_right + 0.2f, 0.06f, house_front + 0.35f});
    part::box(parts.of(materials.boards), {door_left - 0.04f, 0.05f, house_front - 1.2f}, {door_left, door_head - 0.02f, inner});
    // A table with bottles, shelves on the back wall.
    part::box(planks, {-1.3f, 0.72f, -11.3f}, {-0.4f, 0.78f, -10.5f});
    for (const float x : {-1.2f, -0.6f}) part::box(planks, {x, 0, -11.0f}, {x + 0.1f, 0.72f, -10.8f});
    for (const float y : {1.1f, 1.6f, 2.1f}) part::box(planks, {-1.9f, y, room_back}, {-0.2f, y + 0.04f, room_back + 0.3f});
    constexpr glm::vec2 jar[] = {{0.0f, 0.3f}, {0.05f, 0.3f}, {0.05f, 0.26f}, {0.1f, 0.2f}, {0.11f, 0.0f}};
    for (int i = 0; i < 14; ++i)
        part::turned(parts.of(i % 3 == 0   ? materials.lime
                              : i % 3 == 1 ? materials.apple
                                           : materials.ceramic),
                     jar, {-1.8f + 0.25f * float(i % 7), i < 7 ? 1.14f : 1.64f, room_back + 0.15f}, 12);
}

/// A cable that sags between two places.
std::vector<glm::vec3> cable(glm::vec3 from, glm::vec3 to, float sag) {
    std::vector<glm::vec3> line;
    for (int i = 0; i <= 16; ++i) {
        const float t = float(i) / 16;
        line.push_back(glm::mix(from, to, t) - glm::vec3(0, sag * 4 * t * (1 - t), 0));
    }
    return line;
}

void add_cables(FrameBuilder& builder, Parts& parts, const Materials& materials, Lamps& lamps) {
    struct Span {
        glm::vec3 from, to;
        float sag;
        int bulbs;
    };
    const std::uint32_t bulb = builder.add(sphere(0.045f, 8));
    for (const Span& span : {Span{{-side, 4.1f, -3.4f}, {side, 3.7f, -4.6f}, 0.5f, 9},
                             {{-side, 3.9f, -6.8f}, {side, 3.5f, -7.4f}, 0.55f, 9},
                             {{0.35f, 3.7f, -9.6f}, {side, 3.3f, -10.2f}, 0.35f, 6},
                             {{-0.9f, 3.5f, -15}, {side, 3.4f, -14.4f}, 0.4f, 7},
                             {{-side, 5.2f, -5.2f}, {side, 5.6f, -9}, 0.3f, 0},
                             {{-side, 4.9f, -9}, {side, 5.2f, -4}, 0.4f, 0}}) {
        part::pipe(parts.of(materials.rubber), cable(span.from, span.to, span.sag), 0.012f, 5);
        for (int i = 0; i < span.bulbs; ++i) {
            const float t = (float(i) + 0.5f) / float(span.bulbs);
            const glm::vec3 at = glm::mix(span.from, span.to, t) - glm::vec3(0, span.sag * 4 * t * (1 - t) + 0.07f, 0);
            builder.draw(bulb, materials.warm_bulb, {.position = glm::dvec3(at)}).casts_shadow = false;
        }
        if (span.bulbs < 9) continue;
        const glm::dvec3 middle = glm::dvec3(0.5f * (span.from + span.to)) - glm::dvec3(0, span.sag + 0.1, 0);
        lamps.globe("string of bulbs", middle, {2.0f, 1.25f, 0.55f}, 0.3f).range = 6;
    }
}

/// Signs of glass tube and the light they throw.
void add_signs(FrameBuilder& builder, const Materials& materials, Lamps& lamps) {
    const auto sign = [&](Mesh letters, std::uint32_t material, const Pose& place) {
        builder.draw(builder.add(std::move(letters)), material, place).casts_shadow = false;
    };
    Mesh boards;
    part::box(boards, {-2.0f, 2.95f, house_front + 0.05f}, {0.3f, 3.6f, house_front + 0.1f});
    part::box(boards, {1.4f, 2.9f, -12.02f}, {2.6f, 4.6f, -11.96f});
    builder.draw(builder.add(std::move(boards)), materials.iron, {});
    sign(neon_letters("STRATA", 0.37f, Lettering::along), materials.pink_neon, {.position = {-1.92, 3.09, house_front + 0.15}});
    lamps.tube("sign STRATA", {-0.85, 3.25, house_front + 0.35}, {1.1f, 0, 0}, {4.6f, 0.7f, 2.2f});
    sign(neon_letters("NOODLES", 0.19f, Lettering::along), materials.amber_neon, {.position = {1.2, 2.6, -4.75}, .yaw = -0.6});
    lamps.tube("sign NOODLES", {1.7, 2.72, -4.2}, glm::vec3(0.5f, 0, 0.35f), {2.2f, 0.8f, 0.12f});
    sign(neon_letters("TEA", 0.4f, Lettering::down), materials.cyan_neon, {.position = {1.5, 4.1, -11.92}});
    lamps.tube("sign TEA", {1.65, 3.8, -11.7}, {0, 0.7f, 0}, {0.4f, 2.4f, 3.2f});
}

/// Walls and ceiling of the room stop its lamp but for the door, and bounced light.
void light_room(FrameBuilder& builder, const Materials& materials, Lamps& lamps) {
    Frame& frame = builder.frame;
    constexpr double front = house_front - 0.15, right = house_right - 0.15, back = room_back - 0.1, left = room_left - 0.1;
    constexpr double high = room_height + 0.1, middle_x = 0.5 * (left + right), middle_z = 0.5 * (front + back);
    const auto add_wall = [&](glm::dvec3 center, glm::vec3 u, glm::vec3 v, glm::dvec2 half) {
        frame.blockers.push_back({.center = center, .u = u, .v = v, .half_u = float(half.x), .half_v = float(half.y)});
    };
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const double half_x = 0.5 * (right - left), half_y = 0.5 * high, half_z = 0.5 * (front - back);
    add_wall({middle_x, half_y, front}, x, y, {half_x, half_y});
    add_wall({middle_x, half_y, back}, x, y, {half_x, half_y});
    add_wall({left, half_y, middle_z}, z, y, {half_z, half_y});
    add_wall({right, half_y, middle_z}, z, y, {half_z, half_y});
    add_wall({middle_x, high, middle_z}, x, z, {half_x, half_z});
    frame.portals.push_back({.center = {0.5 * (door_left + door_right), 0.5 * door_head, front},
                             .u = x,
                             .v = y,
                             .half_u = 0.5f * (door_right - door_left),
                             .half_v = 0.5f * door_head,
                             .blocker = 0});
    constexpr glm::dvec3 hangs{-0.9, 2.25, -10.9};
    Light& lamp = lamps.globe("lamp of the room", hangs, {30, 18, 7.5f}, 0.15f);
    lamp.range = 11;
    lamp.blockers = {0, 1, 2, 3, 4};
    lamp.portals = {0};
    builder.draw(builder.add(sphere(0.15f, 16)), materials.warm_bulb, {.position = hangs}).casts_shadow = false;
    frame.light_volumes = {{.kind = VolumeKind::fixed_local,
                            .occlusion = VolumeOcclusion::axial,
                            .center = {-1.3, 1.4, -9.7},
                            .half_extent = {2.6f, 1.8f, 3.2f},
                            .cells = {13, 9, 16},
                            .iterations = 12}};
}

}  // namespace

void add_street(FrameBuilder& builder, const Materials& materials, Lamps& lamps) {
    Parts parts(builder);
    add_ground(parts, materials);
    add_walls(parts, materials);
    add_windows(parts, materials);
    add_fittings(parts, materials);
    add_right_wall(builder, parts, materials, lamps);
    add_house(parts, materials);
    add_cables(builder, parts, materials, lamps);
    parts.draw({});
    add_signs(builder, materials, lamps);
    light_room(builder, materials, lamps);
}

}  // namespace strata::scenario::market
