// Reflectance and fog, written from lighting chapter 0.5 and transparency chapter 0.4.
#include "passes/reference/shade.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace strata {
namespace {

constexpr double pi = std::numbers::pi;
// Smallest width of a GGX lobe and smallest cosine of the eye (lighting chapter 0.5).
constexpr double smallest_lobe = 0.002, smallest_cosine = 1e-4;

double saturate(double x) { return std::clamp(x, 0.0, 1.0); }

glm::dvec3 ggx(const SurfacePoint& surface, const glm::dvec3& l, const glm::dvec3& v) {
    const glm::dvec3 h = glm::normalize(l + v);
    const double a = std::max(surface.roughness * surface.roughness, smallest_lobe), a2 = a * a;
    const double n_l = std::max(glm::dot(surface.normal, l), smallest_cosine);
    const double n_v = std::max(glm::dot(surface.normal, v), smallest_cosine);
    const double n_h = saturate(glm::dot(surface.normal, h));
    const double d = a2 / (pi * std::pow(n_h * n_h * (a2 - 1) + 1, 2));
    const double visibility = 0.5 / (n_l * std::sqrt(n_v * n_v * (1 - a2) + a2) + n_v * std::sqrt(n_l * n_l * (1 - a2) + a2));
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), surface.base_color, surface.metallic);
    const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1 - saturate(glm::dot(l, h)), 5);
    return d * visibility * fresnel;
}

}  // namespace

double burley(double roughness, double n_l, double n_v, double l_h) {
    const double f90 = 0.5 + 2 * roughness * l_h * l_h;
    return (1 + (f90 - 1) * std::pow(1 - n_l, 5)) * (1 + (f90 - 1) * std::pow(1 - n_v, 5));
}

double renormalized_burley(double roughness, double n_l, double n_v, double l_h) {
    const double f90 = 0.5 * roughness + 2 * roughness * l_h * l_h;
    const double scatter = (1 + (f90 - 1) * std::pow(1 - n_l, 5)) * (1 + (f90 - 1) * std::pow(1 - n_v, 5));
    return std::lerp(1.0, 1 / 1.51, roughness) * scatter;
}

glm::dvec3 brdf(const SurfacePoint& surface, glm::dvec3 to_light, glm::dvec3 to_eye) {
    const glm::dvec3 lambert = surface.base_color / pi;
    switch (surface.model) {
        case LightingModel::unlit:
            return glm::dvec3(0);
        case LightingModel::lambert:
            return lambert;
        case LightingModel::ggx:
            return lambert * (1 - surface.metallic) + ggx(surface, to_light, to_eye);
        case LightingModel::burley:
            break;
    }
    const double n_l = saturate(glm::dot(surface.normal, to_light));
    const double n_v = std::clamp(glm::dot(surface.normal, to_eye), smallest_cosine, 1.0);
    const double l_h = saturate(glm::dot(to_light, glm::normalize(to_light + to_eye)));
    const double shape = renormalized_burley(surface.roughness, n_l, n_v, l_h);
    return lambert * ((1 - surface.metallic) * shape) + ggx(surface, to_light, to_eye);
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
    const glm::dvec3 world_normal = glm::transpose(frame.view.to_view) * surface.normal;
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
