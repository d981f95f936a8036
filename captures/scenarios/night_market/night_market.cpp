// A market street at night, in the rain: wet setts, stalls under striped awnings, lanterns, neon, steam over a pot, smoke of a
// grill, panes of colored glass through each other, a lit room behind an open door, the moon over the roofs. It has every stage
// of a frame: what one of them lacks, no picture of this street is without.
#include "captures/scenarios/night_market/night_market.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace market {

Light& Lamps::add(std::string name, LightType type, glm::dvec3 position, glm::vec3 intensity) {
    shines_.push_back({position, intensity});
    Light& light = builder_->frame.lights.emplace_back();
    light.name = std::move(name);
    light.type = type;
    light.position = position;
    light.intensity = intensity;
    light.range = 6;
    return light;
}

Light& Lamps::globe(std::string name, glm::dvec3 position, glm::vec3 intensity, float radius) {
    Light& light = add(std::move(name), LightType::sphere, position, intensity);
    light.intensity = intensity / (std::numbers::pi_v<float> * radius * radius);  // radiance of a disc of that radius
    light.source_radius = radius;
    return light;
}

Light& Lamps::tube(std::string name, glm::dvec3 middle, glm::vec3 half_axis, glm::vec3 intensity) {
    constexpr float radius = 0.03f;
    const float half_length = glm::length(half_axis);
    Light& light = add(std::move(name), LightType::tube, middle, intensity);
    light.axis_u = half_axis / half_length;
    light.direction = std::abs(light.axis_u.z) < 0.5f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    light.half_extent = {half_length, 0};
    light.source_radius = radius;
    light.intensity = intensity / (4 * radius * half_length);  // radiance of a rectangle as long and as wide
    light.range = 9;
    return light;
}

Light& Lamps::spot(std::string name, glm::dvec3 position, glm::vec3 direction, glm::vec3 intensity) {
    Light& light = add(std::move(name), LightType::round_spot, position, intensity);
    light.direction = direction;
    light.axis_u =
        std::abs(direction.x) < 0.5f ? glm::normalize(glm::vec3(1, 0, 0) - direction * direction.x) : glm::vec3(0, 0, 1);
    return light;
}

glm::vec3 Lamps::scattered(glm::dvec3 place) const {
    glm::vec3 sum(0.014f, 0.02f, 0.034f);  // of the moon and the sky
    for (const Shine& shine : shines_) {
        const glm::dvec3 offset = place - shine.position;
        const auto squared = static_cast<float>(glm::dot(offset, offset));
        if (squared > 36) continue;
        const float window = 1 - squared / 36;
        sum += shine.intensity * (window * window / (4 * std::numbers::pi_v<float> * (squared + 0.25f)));
    }
    return sum;
}

namespace {

void add_moon(FrameBuilder& builder) {
    Sun& moon = builder.frame.sun;
    moon.direction = glm::normalize(glm::vec3(0.22f, -0.72f, 0.66f));
    moon.irradiance = {0.6f, 0.92f, 1.6f};
    moon.shadow = {.casts = true, .map_size = 512, .bias = 0.03f, .soft = false};
    moon.cascades = 2;
    moon.shadow_distance = 26;
    moon.shafts = true;
    builder.frame.hemisphere = {.sky = {0.026f, 0.044f, 0.085f}, .ground = {0.018f, 0.014f, 0.012f}};
    builder.frame.background = {0.02f, 0.034f, 0.07f};
    builder.frame.fog = {.density = 0.022f, .color = {0.036f, 0.052f, 0.092f}};
}

void add_weather_and_lens(Frame& frame) {
    frame.rain = {.intensity = 0.6f, .wetness = 0.7f, .direction = glm::normalize(glm::vec3(0.1f, -1, 0))};
    frame.lens = {.bloom = 0.18f,
                  .bloom_threshold = 1,
                  .auto_exposure = false,
                  .exposure_speed = 1,
                  .focus_distance = 5.6f,
                  .aperture = 0.045f,
                  .distortion = false};
    frame.film = {.grain = 0.03f, .fade = 0, .white = 1.7f};
}

}  // namespace
}  // namespace market

Frame night_market(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    const double walked = 0.6 * (builder.progress() - 1);
    builder.look({.eye = {0.3, 1.55, 0.5 - walked}, .target = {-0.12, 1.62, -8 - walked}, .vertical_fov = 0.74, .swing = 0.03});
    const market::Materials materials = market::add_materials(builder);
    market::Lamps lamps(builder);
    market::add_moon(builder);
    market::add_street(builder, materials, lamps);
    market::add_stalls(builder, materials, lamps);
    market::add_people(builder, materials);
    market::add_air(builder, lamps);
    market::add_weather_and_lens(builder.frame);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
