#include "passes/lighting/brute_force/light_buffer_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/light_types.h"
#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/reference/brdf.h"
#include "passes/reference/lights.h"
#include "passes/reference/placed_light.h"

namespace strata::lighting {
namespace {

using std::numbers::pi;

/// A light that comes from one direction.
struct Arriving {
    glm::dvec3 to_light{0};
    glm::dvec3 irradiance{0};  ///< perpendicular to it
    double cosine = 0;         ///< to the surface's normal
};

/// What is left of the light after range, cone, picture and clip planes is what a white Lambert surface reflects of it.
Arriving arriving(const Frame& frame, const SurfacePoint& surface, const Light& light) {
    SurfacePoint white = surface;
    white.model = LightingModel::lambert;
    white.normal = facing_normal(surface);
    white.base_color = glm::dvec3(1);
    const PlacedLight at = placed(frame, surface, light);
    Arriving arriving;
    arriving.to_light = glm::normalize(has_range(light.type) ? at.offset : -at.direction);
    arriving.cosine = glm::dot(white.normal, arriving.to_light);
    if (arriving.cosine > 0) arriving.irradiance = pi / arriving.cosine * reflected(frame, white, light);
    return arriving;
}

glm::dvec3 in_highlights(const glm::dvec3& irradiance, std::uint32_t specular) {
    return specular == specular_white ? glm::dvec3((irradiance.x + irradiance.y + irradiance.z) / 3) : irradiance;
}

glm::dvec3 reflectance_at_normal(const SurfacePoint& surface) {
    return glm::mix(glm::dvec3(0.04), surface.base_color, surface.metallic);
}

Accumulated by_table(const SurfacePoint& surface, const Arriving& from, std::uint32_t specular) {
    const glm::dvec3 half_way = glm::normalize(from.to_light + glm::normalize(-surface.position));
    const double n_h = std::clamp(glm::dot(facing_normal(surface), half_way), 0.0, 1.0);
    const std::uint32_t slice = material_slice(surface);
    const TableShares at = material_in_table(slice, from.cosine, n_h);
    const glm::dvec3 diffuse = surface.base_color * at.shares.x * from.irradiance;
    const glm::dvec3 highlight = material_gloss(surface, slice) * at.shares.y * in_highlights(from.irradiance, specular);
    return {(diffuse + highlight) / pi, at.undecided};
}

/// What is over the diffuse layer: all of the BRDF but that layer, whose models are Lambert's, Burley's and what a highlight of
/// many bounces leaves of Lambert's.
glm::dvec3 highlight_of(const SurfacePoint& surface, const glm::dvec3& l) {
    const glm::dvec3 v = glm::normalize(-surface.position), f0 = reflectance_at_normal(surface);
    const double n_l = std::clamp(glm::dot(surface.normal, l), 0.0, 1.0);
    const double n_v = std::clamp(glm::dot(surface.normal, v), smallest_cosine, 1.0);
    const double l_h = std::clamp(glm::length(l + v) / 2, 0.0, 1.0);
    glm::dvec3 diffuse = surface.base_color * ((1 - surface.metallic) / pi);
    if (surface.model == LightingModel::burley) diffuse *= renormalized_burley(surface.roughness, n_l, n_v, l_h);
    if (surface.model == LightingModel::plain_burley) diffuse *= burley(surface.roughness, n_l, n_v, l_h);
    if (surface.model == LightingModel::multiscatter_ggx) {
        const double all = std::min(fitted_ggx_albedo(n_v, std::max(surface.roughness * surface.roughness, smallest_lobe)), 1.0);
        const double grazing = fitted_ggx_grazing(n_v, surface.roughness);
        diffuse *= 1.0 - (1.0 + f0 * (1 / all - 1)) * (f0 * (all - grazing) + grazing);
    }
    return brdf(surface, l, v) - diffuse;
}

bool has_highlight_of_its_own(LightingModel model) {
    return model == LightingModel::ggx || model == LightingModel::burley || model == LightingModel::plain_burley ||
           model == LightingModel::multiscatter_ggx;
}

}  // namespace

Accumulated accumulated(const Frame& frame, const SurfacePoint& surface, const Light& light, const BruteForceParams& params) {
    if (surface.model == LightingModel::unlit) return {};
    const bool by_formula = params.materials == materials_recorded;
    if (is_area(light.type) || (by_formula && !has_highlight_of_its_own(surface.model)))
        return {reflected(frame, surface, light)};
    const Arriving from = arriving(frame, surface, light);
    if (from.cosine <= 0 || from.irradiance == glm::dvec3(0)) return {};
    if (!by_formula) return by_table(surface, from, params.specular);
    const glm::dvec3 paled = in_highlights(from.irradiance, params.specular) - from.irradiance;
    return {reflected(frame, surface, light) + highlight_of(surface, from.to_light) * from.cosine * paled};
}

}  // namespace strata::lighting
