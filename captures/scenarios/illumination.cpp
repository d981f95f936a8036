// Lights and their shadows: a sun, a spot, many lights, and many objects.
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

void add_daylight(Frame& frame) {
    frame.sun.direction = glm::normalize(glm::vec3(-0.6f, -1, 0.35f));
    frame.sun.irradiance = {3, 2.8f, 2.4f};
    frame.sun.shadow.casts = true;
    frame.hemisphere = {.sky = {0.35f, 0.45f, 0.65f}, .ground = {0.2f, 0.18f, 0.15f}};
    frame.background = {0.5f, 0.65f, 0.9f};
}

/// A light at a place with the intensity that makes white paint `brightness` at a distance of 1 m.
Light lamp(std::string name, glm::dvec3 position, glm::vec3 brightness) {
    Light light;
    light.name = std::move(name);
    light.position = position;
    light.intensity = brightness * std::numbers::pi_v<float>;
    return light;
}

}  // namespace

Frame sun_and_boxes(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 2.2, 6}, .target = {0, 1, -6}, .swing = 0.1});
    const std::uint32_t tower = builder.add(box({0.5f, 1, 0.5f}));
    builder.draw(builder.add(box({40, 0.5f, 50})), builder.add(lambert("ground", {0.5f, 0.48f, 0.42f})),
                 {.position = {0, -0.5, -40}});
    const std::uint32_t stone = builder.add(lambert("stone", {0.6f, 0.55f, 0.5f}));
    Random random(builder.seed());
    for (int row = 0; row < 12; ++row) {  // from 3 to 56 m: through all cascades
        const double z = 3 - 0.4 * row * (row + 1);
        for (const double side : {-1.0, 1.0}) {
            const double height = random.between(0.6, 1.6);
            builder.draw(
                tower, stone,
                {.position = {side * (2 + 0.25 * row), height, z}, .yaw = random.between(0.0, 1.5), .scale = {1, height, 1}});
        }
    }
    Draw& cart = builder.draw(tower, builder.add(lambert("cart", {0.7f, 0.2f, 0.1f})),
                              {.position = {0.5, 0.5, -2 * builder.progress()}, .scale = {1, 0.5, 1}});
    cart.mobility = Mobility::moving;
    cart.previous_to_world = transform({.position = {0.5, 0.5, -2 * builder.previous_progress()}, .scale = {1, 0.5, 1}});
    add_daylight(builder.frame);
    return std::move(builder.frame);
}

/// The spot hangs 3 m above the floor, straight over the box's left edge: the shadow's right border lies under that edge.
Frame spot_and_box(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.5, 2.4, 3.6}, .target = {0, 0.2, 0}});
    builder.draw(builder.add(box({3, 0.1f, 3})), builder.add(lambert("floor", glm::vec3(0.6f))), {.position = {0, -0.1, 0}});
    builder.draw(builder.add(box(glm::vec3(0.3f))), builder.add(lambert("box", {0.7f, 0.3f, 0.1f})), {.position = {0.3, 0.5, 0}});
    Light spot = lamp("spot", {0, 3, 0}, glm::vec3(9));
    spot.type = LightType::round_spot;
    spot.range = 8;
    spot.inner_angle = 0.35f;
    spot.outer_angle = 0.5f;
    spot.shadow.casts = true;
    builder.frame.lights.push_back(spot);
    builder.frame.hemisphere = {.sky = glm::vec3(0.06f), .ground = glm::vec3(0.04f)};
    return std::move(builder.frame);
}

Frame lights_room(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.7, 4.5}, .target = {0, 1.2, -2}, .swing = 0.15});
    const std::uint32_t paint = builder.add(lambert("paint", glm::vec3(0.6f)));
    const std::uint32_t slab = builder.add(box({6, 0.1f, 6})), cube = builder.add(box(glm::vec3(0.4f)));
    builder.draw(slab, paint, {.position = {0, -0.1, 0}});
    builder.draw(builder.add(box({6, 2, 0.1f})), paint, {.position = {0, 2, -6.1}});
    for (const double side : {-1.0, 1.0}) {
        builder.draw(builder.add(box({0.1f, 2, 6})), paint, {.position = {side * 6.1, 2, 0}});
    }
    Random random(builder.seed());
    for (int i = 0; i < 10; ++i) {
        builder.draw(cube, paint,
                     {.position = {random.between(-4.0, 4.0), 0.4, random.between(-5.0, 2.0)}, .yaw = random.between(0.0, 1.5)});
    }
    for (int i = 0; i < 32; ++i) {
        const double turn = 2 * std::numbers::pi * (random.unit() + 0.2 * builder.progress());
        const glm::dvec3 center{random.between(-5.0, 5.0), random.between(0.5, 2.5), random.between(-5.5, 3.0)};
        const glm::vec3 color{random.between(0.2f, 1.0f), random.between(0.2f, 1.0f), random.between(0.2f, 1.0f)};
        Light light = lamp("lamp", center + 0.3 * glm::dvec3(std::cos(turn), 0, std::sin(turn)), color);
        light.range = random.between(1.5f, 3.5f);
        if (i % 2 == 1) {
            light.name = "spot";
            light.type = LightType::round_spot;
            light.direction = glm::normalize(glm::vec3{random.between(-0.7f, 0.7f), -1, random.between(-0.7f, 0.7f)});
            light.axis_u = glm::normalize(glm::cross(light.direction, glm::vec3(0, 0, 1)));
            light.intensity *= 3.0f;
        }
        builder.frame.lights.push_back(light);
    }
    builder.frame.hemisphere = {.sky = glm::vec3(0.05f), .ground = glm::vec3(0.03f)};
    return std::move(builder.frame);
}

namespace {

/// From x = -4 to 4 and z = -4 to 0 with a wall at x = 0, 20 cm thick and 2.4 m high, and a door of 80 cm by 2 m in it.
void build_rooms(FrameBuilder& builder) {
    const std::uint32_t paint = builder.add(lambert("paint", glm::vec3(0.6f)));
    builder.draw(builder.add(box({4, 0.1f, 2})), builder.add(lambert("floor", {0.5f, 0.45f, 0.4f})), {.position = {0, -0.1, -2}});
    builder.draw(builder.add(box({4, 1.2f, 0.1f})), paint, {.position = {0, 1.2, -4.1}});
    const std::uint32_t beside_door = builder.add(box({0.1f, 1.2f, 0.8f}));
    for (const double z : {-0.8, -3.2}) builder.draw(beside_door, paint, {.position = {0, 1.2, z}});
    builder.draw(builder.add(box({0.1f, 0.2f, 0.4f})), paint, {.position = {0, 2.2, -2}});
    builder.draw(builder.add(box({0.5f, 0.02f, 0.4f})), paint, {.position = {2.4, 0.9, -2.6}});
    Material curtain = lambert("curtain", {0.8f, 0.7f, 0.6f});
    curtain.alpha_mode = AlphaMode::blend;
    curtain.base_color.w = 0.5f;
    curtain.double_sided = true;
    builder.draw(builder.add(quad({1.4f, 1.1f})), builder.add(curtain), {.position = {1.2, 1.1, -1.8}, .yaw = -0.9});
}

}  // namespace

/// The lamps are held by the wall and pass the door in it. The board in the right room keeps a dark away from what is under it.
Frame blocker_rooms(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.6, 2.9, 4.2}, .target = {0, 0.7, -2}, .swing = 0.1});
    build_rooms(builder);
    Frame& f = builder.frame;
    f.blockers = {
        {.center = {0, 1.2, -2}, .u = {0, 0, 1}, .v = {0, 1, 0}, .half_u = 2, .half_v = 1.2f},
        {.center = {2.4, 0.9, -2.6}, .u = {0, 0, 1}, .v = {1, 0, 0}, .half_u = 0.4f, .half_v = 0.5f, .one_sided = true}};
    f.portals = {{.center = {0, 1, -2}, .u = {0, 0, 1}, .v = {0, 1, 0}, .half_u = 0.4f, .half_v = 1}};
    Light warm = lamp("warm", {-2.2, 1.7, -1.6}, {2.5f, 1.6f, 0.8f}), cold = lamp("cold", {2.6, 1.9, -1.2}, {0.6f, 1.2f, 2.2f});
    for (Light* light : {&warm, &cold}) {
        light->range = 7;
        light->blockers = {0};
        light->portals = {0};
    }
    cold.blockers = {0, 1};
    Light dark;
    dark.name = "dark";
    dark.type = LightType::directional;
    dark.intensity = glm::vec3(-0.25f);
    dark.blockers = {1};
    f.lights = {warm, cold, dark};
    f.hemisphere = {.sky = glm::vec3(0.15f), .ground = glm::vec3(0.12f)};
    return std::move(f);
}

Frame city_of_boxes(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.7, 2}, .target = {0, 2, -10}, .swing = 0.05});
    const std::uint32_t block = builder.add(box(glm::vec3(1)));
    builder.draw(builder.add(box({90, 0.5f, 90})), builder.add(lambert("street", glm::vec3(0.35f))), {.position = {0, -0.5, 0}});
    const std::uint32_t brick = builder.add(lambert("brick", {0.55f, 0.25f, 0.18f}));
    const std::uint32_t concrete = builder.add(lambert("concrete", glm::vec3(0.55f)));
    Random random(builder.seed());
    for (int row = 0; row < 20; ++row) {
        for (int column = 0; column < 20; ++column) {  // blocks of 8 m; the eye stands in the middle of a street
            const double height = random.between(1.0, 6.0);
            const std::uint32_t material = random.unit() < 0.5 ? brick : concrete;
            builder.draw(block, material,
                         {.position = {8.0 * column - 76, height, 8.0 * row - 76},
                          .scale = {random.between(1.5, 2.8), height, random.between(1.5, 2.8)}});
        }
    }
    add_daylight(builder.frame);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
