// Many lights: halls whose lights shrink as they grow in number, and more pairs of lights and blockers than a tile keeps.
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

constexpr glm::dvec3 hall{6, 2.5, 30};  // half extent; the eye stands at +z

void add_hall(FrameBuilder& builder) {
    const std::uint32_t paint = builder.add(lambert("paint", glm::vec3(0.6f)));
    Material polished = lambert("polished floor", {0.35f, 0.3f, 0.26f});
    polished.lighting_model = LightingModel::ggx;
    polished.roughness = 0.45f;
    builder.draw(builder.add(box({hall.x, 0.1, hall.z})), builder.add(polished), {.position = {0, -0.1, 0}});
    for (const double side : {-1.0, 1.0})
        builder.draw(builder.add(box({0.1, hall.y, hall.z})), paint, {.position = {side * (hall.x + 0.1), hall.y, 0}});
    builder.draw(builder.add(box({hall.x, hall.y, 0.1})), paint, {.position = {0, hall.y, -hall.z - 0.1}});
    const std::uint32_t column = builder.add(box({0.35f, float(hall.y), 0.35f}));
    for (int i = 0; i < 16; ++i) builder.draw(column, paint, {.position = {i % 2 == 0 ? -3 : 3, hall.y, hall.z - 6 - 3.4 * i}});
}

/// Every third one a spot. A light reaches 6 m among 64, and as far less among more that about 16 reach any point.
Light hall_light(std::uint32_t index, double range, Random& random) {
    Light light;
    light.name = "light " + std::to_string(index);
    light.position = {random.between(-hall.x, hall.x), random.between(0.2, 2 * hall.y - 0.2), random.between(-hall.z, hall.z)};
    light.range = static_cast<float>(range);
    const glm::vec3 color{random.between(0.2f, 1.0f), random.between(0.2f, 1.0f), random.between(0.2f, 1.0f)};
    light.intensity = color * static_cast<float>(0.12 * range * range);
    if (index % 3 != 2) return light;
    light.type = LightType::round_spot;
    light.direction = glm::normalize(glm::vec3{random.between(-0.7f, 0.7f), -1, random.between(-0.7f, 0.7f)});
    light.axis_u = glm::normalize(glm::cross(light.direction, glm::vec3(0, 0, 1)));
    light.intensity *= 2.0f;
    return light;
}

Frame hall_with(std::uint32_t lights, std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.5, 1.7, hall.z - 1}, .target = {0, 1.5, 0}, .swing = 0.04});
    add_hall(builder);
    Random random(builder.seed());
    const double range = 6 * std::cbrt(64.0 / lights);
    for (std::uint32_t i = 0; i < lights; ++i) builder.frame.lights.push_back(hall_light(i, range, random));
    builder.frame.hemisphere = {.sky = glm::vec3(0.03f), .ground = glm::vec3(0.02f)};
    return std::move(builder.frame);
}

}  // namespace

Frame hall_of_lights_1(std::uint32_t frame, const ScenarioOptions& options) { return hall_with(1, frame, options); }
Frame hall_of_lights_64(std::uint32_t frame, const ScenarioOptions& options) { return hall_with(64, frame, options); }
/// Four times as wide, as bright as the others, and without spots, whose cones may miss the view: tiles that see the hall from
/// end to end have all 65.
Frame hall_of_lights_65(std::uint32_t frame, const ScenarioOptions& options) {
    Frame made = hall_with(65, frame, options);
    for (Light& light : made.lights) light.type = LightType::omni, light.range *= 4;
    return made;
}
Frame hall_of_lights_512(std::uint32_t frame, const ScenarioOptions& options) { return hall_with(512, frame, options); }
Frame hall_of_lights_4096(std::uint32_t frame, const ScenarioOptions& options) { return hall_with(4096, frame, options); }

/// A grate of 17 slats, each with a slit, under 16 lights that all reach the floor: 272 pairs of lights and blockers, and as
/// many of lights and portals, in every tile.
Frame pair_overflow(std::uint32_t frame, const ScenarioOptions& options) {
    constexpr std::uint32_t lights = 16, slats = 17;
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 3, 5}, .target = {0, 0.4, 0}, .swing = 0.1});
    builder.draw(builder.add(box({5, 0.1f, 5})), builder.add(lambert("floor", glm::vec3(0.7f))), {.position = {0, -0.1, 0}});
    builder.draw(builder.add(box({5, 2, 0.1f})), builder.add(lambert("wall", glm::vec3(0.5f))), {.position = {0, 2, -4}});
    Frame& made = builder.frame;
    for (std::uint32_t i = 0; i < slats; ++i) {
        const glm::dvec3 center{-3.2 + 0.4 * i, 1.6, 0};
        made.blockers.push_back({.center = center, .u = {1, 0, 0}, .v = {0, 0, 1}, .half_u = 0.12f, .half_v = 1.8f});
        made.portals.push_back({.center = center, .u = {1, 0, 0}, .v = {0, 0, 1}, .half_u = 0.05f, .half_v = 0.9f, .blocker = i});
    }
    Random random(builder.seed());
    for (std::uint32_t i = 0; i < lights; ++i) {
        Light light;
        light.name = "bulb " + std::to_string(i);
        light.position = {-3 + 0.4 * i, 2.6 + 0.3 * random.unit(), random.between(-1.0, 1.0)};
        light.intensity = glm::vec3{random.between(0.3f, 1.0f), random.between(0.3f, 1.0f), random.between(0.3f, 1.0f)};
        light.range = 12;
        for (std::uint32_t slat = 0; slat < slats; ++slat) {
            light.blockers.push_back(slat);
            light.portals.push_back(slat);
        }
        made.lights.push_back(light);
    }
    made.hemisphere = {.sky = glm::vec3(0.03f), .ground = glm::vec3(0.02f)};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
