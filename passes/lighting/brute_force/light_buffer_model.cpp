#include "passes/lighting/brute_force/light_buffer_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "passes/reference/brdf.h"
#include "passes/reference/lights.h"
#include "passes/reference/placed_light.h"

namespace strata::lighting {
namespace {

using std::numbers::pi;

/// Rings of the metal around equal cosines.
double metal(double ld, double ls) {
    const auto ring = [](double x) { return std::abs(1 - std::abs(x)); };
    const double widest =
        std::max({ring(0.05 * std::sin(33 * ld) + ld - ls), ring(0.05 * std::cos(33 * ld * ls) + ld - ls), ring(ld - ls)});
    return std::pow(widest, 24) * std::pow(ld, 1.0 / 7);
}

struct Texel {
    glm::dvec2 value{0};
    bool undecided = false;
};

Texel table_texel(std::uint32_t slice, int x, int y) {
    // What a float of the device is off by before it is cut, in steps: the 128th power of one by its last bit is 8e-6.
    constexpr double doubtful = 3e-3;
    const glm::dvec2 exact = material_formula(slice, x / double(table_width - 1), y / double(table_height - 1));
    Texel texel;
    for (int c = 0; c < 2; ++c) {
        const double step = 255.5 * std::min(exact[c], 1.0);
        texel.value[c] = std::floor(step) / 255;
        texel.undecided |= std::abs(step - std::round(step)) < doubtful && std::round(step) > 0;
    }
    return texel;
}

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
    arriving.to_light = light.type == LightType::directional ? -glm::normalize(at.direction) : glm::normalize(at.offset);
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

std::uint32_t slice_of(const SurfacePoint& surface) {
    if (surface.metallic >= double(least_metal)) return slice_metal;
    if (surface.roughness < double(least_blinn_roughness)) return slice_phong;
    return surface.roughness < double(least_rough_roughness) ? slice_blinn : slice_rough;
}

double gloss_of(const SurfacePoint& surface, std::uint32_t slice) {
    if (surface.model == LightingModel::lambert) return 0;
    constexpr std::array<float, table_slices> per_f0 = {gloss_rough, gloss_blinn, gloss_phong, gloss_metal};
    const glm::dvec3 f0 = reflectance_at_normal(surface);
    return std::min(double(per_f0[slice]) * (f0.x + f0.y + f0.z) / 3, 1.0);
}

Accumulated by_table(const SurfacePoint& surface, const Arriving& from, std::uint32_t specular) {
    const glm::dvec3 half_way = glm::normalize(from.to_light + glm::normalize(-surface.position));
    const double n_h = std::clamp(glm::dot(facing_normal(surface), half_way), 0.0, 1.0);
    const std::uint32_t slice = slice_of(surface);
    const TableShares at = material_in_table(slice, from.cosine, n_h);
    const glm::dvec3 diffuse = surface.base_color * at.shares.x * from.irradiance;
    const glm::dvec3 highlight = gloss_of(surface, slice) * at.shares.y * in_highlights(from.irradiance, specular);
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

glm::dvec2 material_formula(std::uint32_t slice, double n_l, double n_h) {
    const double ld = n_l, ls = n_h * std::pow(ld, 1.0 / 32);
    switch (slice) {
        case slice_rough:
            return {std::pow(ld, 0.75), 0.5 * std::pow(ls, 16)};
        case slice_blinn:
            return {std::pow(ld, 0.9), std::pow(ls, 24)};
        case slice_phong:
            return {ld, std::min(std::pow(1.01 * ls, 128), 1.0)};
        default:
            return {ld, std::min(metal(ld, ls), 1.0)};
    }
}

TableShares material_in_table(std::uint32_t slice, double n_l, double n_h) {
    const double x = std::clamp(n_l * table_width - 0.5, 0.0, table_width - 1.0);
    const double y = std::clamp(n_h * table_height - 0.5, 0.0, table_height - 1.0);
    TableShares sum;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const double left = std::floor(x) + i, lower = std::floor(y) + j;
            const double weight = (1 - std::abs(x - left)) * (1 - std::abs(y - lower));
            if (weight <= 0) continue;
            const Texel texel = table_texel(slice, int(left), int(lower));
            sum.shares += weight * texel.value;
            sum.undecided |= texel.undecided;
        }
    return sum;
}

Accumulated accumulated(const Frame& frame, const SurfacePoint& surface, const Light& light, const BruteForceParams& params) {
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
