// Light and fog, written from lighting chapter 0.3 and 0.4 and transparency chapter 0.4.
#include "passes/reference/shade.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace strata {
namespace {

// Metres: the inverse square law ends here (lighting chapter 0.3, e).
constexpr double nearest_light = 0.01;

double saturate(double x) { return std::clamp(x, 0.0, 1.0); }

struct Incident {
    glm::dvec3 to_light{0};
    glm::dvec3 irradiance{0};  ///< on a plane facing the light
};

double window(double distance, double range) {
    const double rest = saturate(1 - std::pow(distance / range, 4));
    return distance < range ? rest * rest : 0;
}

double cone(const Frame& frame, const Light& light, const glm::dvec3& to_light) {
    const glm::dvec3 axis = frame.view.to_view * glm::dvec3(light.direction);
    const double outer = std::cos(double(light.outer_angle)), inner = std::cos(double(light.inner_angle));
    const double t = saturate((glm::dot(-to_light, axis) - outer) / std::max(inner - outer, 1e-4));
    return t * t;
}

Incident incident(const Frame& frame, const Light& light, const glm::dvec3& position) {
    const glm::dvec3 intensity = light.intensity;
    if (light.type == LightType::directional) return {-(frame.view.to_view * glm::dvec3(light.direction)), intensity};
    if (light.type != LightType::omni && light.type != LightType::round_spot) return {};
    const glm::dvec3 offset = to_view(frame, light.position) - position;
    const double distance = glm::length(offset);
    if (distance == 0) return {};
    const glm::dvec3 to_light = offset / distance;
    const double share = light.type == LightType::round_spot ? cone(frame, light, to_light) : 1;
    const double squared = std::max(distance * distance, nearest_light * nearest_light);
    return {to_light, intensity * (share * window(distance, double(light.range)) / squared)};
}

}  // namespace

glm::dvec3 reflected(const Frame& frame, const SurfacePoint& surface, const Light& light) {
    const Incident arriving = incident(frame, light, surface.position);
    const double cosine = brdf_cosine(surface, arriving.to_light);
    if (cosine <= 0 || arriving.irradiance == glm::dvec3(0)) return glm::dvec3(0);
    return brdf(surface, arriving.to_light, glm::normalize(-surface.position)) * arriving.irradiance * cosine;
}

Light sun_light(const Frame& frame) {
    Light light;
    light.name = "sun";
    light.type = LightType::directional;
    light.direction = frame.sun.direction;
    light.intensity = frame.sun.irradiance;
    light.shadow = frame.sun.shadow;
    return light;
}

glm::dvec3 hemisphere_light(const Frame& frame, const SurfacePoint& surface) {
    if (surface.model == LightingModel::unlit) return glm::dvec3(0);
    const glm::dvec3 world_normal = glm::transpose(frame.view.to_view) * facing_normal(surface);
    const glm::dvec3 radiance =
        glm::mix(glm::dvec3(frame.hemisphere.ground), glm::dvec3(frame.hemisphere.sky), 0.5 + 0.5 * world_normal.y);
    return surface.base_color * (1 - surface.metallic) * radiance * surface.occlusion;
}

FogAt fog_at(const Frame& frame, double z) {
    const double remains = std::exp(-double(frame.fog.density) * z);
    return {.remains = remains, .added = (1 - remains) * glm::dvec3(frame.fog.color)};
}

glm::dvec3 to_view(const Frame& frame, const glm::dvec3& world) { return frame.view.to_view * (world - frame.view.origin); }

glm::dvec3 pixel_ray(const Frame& frame, double px, double py) {
    const View& view = frame.view;
    const glm::dmat4 m = view.projection;
    // Clip space, y down; jitter moves it.
    const double x = 2 * px / view.width - 1 - double(view.jitter.x), y = 2 * py / view.height - 1 - double(view.jitter.y);
    return {(x - m[2][0]) / m[0][0], (y - m[2][1]) / m[1][1], 1};
}

glm::dvec2 sample_position(std::uint32_t samples, std::uint32_t sample) {
    // Vulkan's standard positions (deferred chapter 0.4).
    constexpr std::array<glm::dvec2, 4> four = {{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
    assert(samples == 1 || samples == 4);
    return samples == 1 ? glm::dvec2(0.5) : four[sample];
}

}  // namespace strata
