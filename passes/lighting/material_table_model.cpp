#include "passes/lighting/material_table_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strata::lighting {
namespace {

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

std::uint32_t material_slice(const SurfacePoint& surface) {
    if (surface.metallic >= double(least_metal)) return slice_metal;
    if (surface.roughness < double(least_blinn_roughness)) return slice_phong;
    return surface.roughness < double(least_rough_roughness) ? slice_blinn : slice_rough;
}

double material_gloss(const SurfacePoint& surface, std::uint32_t slice) {
    if (surface.model == LightingModel::lambert) return 0;
    const std::array<float, table_slices> per_f0 = {gloss_rough, gloss_blinn, gloss_phong, gloss_metal};
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), surface.base_color, surface.metallic);
    return std::min(double(per_f0[slice]) * (f0.x + f0.y + f0.z) / 3, 1.0);
}

}  // namespace strata::lighting
