// Ambient light and fog, written from docs/algorithms/lighting.md 0.3 and docs/algorithms/transparency.md 0.4.
#include "passes/reference/shade.h"

#include <array>
#include <cassert>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/brdf.h"
#include "passes/reference/ltc_table.h"

namespace strata {
Light sun_light(const Frame& frame) {
    Light light;
    light.name = "sun";
    light.type = LightType::directional;
    light.direction = frame.sun.direction;
    light.intensity = frame.sun.irradiance;
    light.shadow = frame.sun.shadow;
    return light;
}

namespace {

/// The share of the lobe above the horizon: the plane of the horizon, brought to where the lobe is a cosine's.
double share_above(const Ltc& lobe, const glm::dvec3& up) {
    const glm::dmat3 matrix(glm::dvec3(lobe.m11, 0, lobe.m31), glm::dvec3(0, lobe.m22, 0), glm::dvec3(lobe.m13, 0, lobe.m33));
    return .5 + .5 * glm::normalize(glm::transpose(matrix) * up).z;
}

glm::dvec3 hemisphere_in_metal(const Frame& frame, const SurfacePoint& surface) {
    const glm::dvec3 n = facing_normal(surface), v = glm::normalize(-surface.position);
    const Ltc lobe = ltc_at(surface.roughness, std::max(glm::dot(n, v), smallest_cosine));
    const glm::dvec3 above = frame.view.to_view * glm::dvec3(0, 1, 0);
    // Where the eye looks along the normal the lobe is round, and any axis will do.
    const glm::dvec3 other = std::abs(n.x) < .5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 beside = glm::length(glm::cross(n, v)) > 1e-9 ? v : other;
    const glm::dvec3 x = glm::normalize(beside - n * glm::dot(n, beside));
    const glm::dvec3 up(glm::dot(x, above), glm::dot(glm::cross(n, x), above), glm::dot(n, above));
    const glm::dvec3 ground(frame.hemisphere.ground), sky(frame.hemisphere.sky);
    return reflectance(lobe, surface.model, surface.base_color) * glm::mix(ground, sky, share_above(lobe, up));
}

}  // namespace

glm::dvec3 hemisphere_light(const Frame& frame, const SurfacePoint& surface) {
    if (surface.model == LightingModel::unlit) return glm::dvec3(0);
    const glm::dvec3 world_normal = glm::transpose(frame.view.to_view) * facing_normal(surface);
    const glm::dvec3 radiance =
        glm::mix(glm::dvec3(frame.hemisphere.ground), glm::dvec3(frame.hemisphere.sky), 0.5 + 0.5 * world_normal.y);
    const glm::dvec3 diffuse = surface.base_color * (1 - surface.metallic) * radiance;
    if (surface.metallic == 0) return diffuse * surface.occlusion;
    return (diffuse + surface.metallic * hemisphere_in_metal(frame, surface)) * surface.occlusion;
}

double fog_way(FogPath path, const glm::dvec3& position) {
    return path == FogPath::distance ? glm::length(position) : position.z;
}

FogAt fog_at(const Frame& frame, double meters) {
    const double remains = std::exp(-double(frame.fog.density) * meters);
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
    // Vulkan's standard positions (docs/algorithms/deferred.md 0.4).
    constexpr std::array<glm::dvec2, 4> four = {{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
    assert(samples == 1 || samples == 4);
    return samples == 1 ? glm::dvec2(0.5) : four[sample];
}

}  // namespace strata
