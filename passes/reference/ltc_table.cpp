#include "passes/reference/ltc_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strata {
namespace {

constexpr std::array<LtcRecord, ltc_edge* ltc_edge> table = {{
#include "passes/reference/ltc_table.inc"
}};

}  // namespace

std::span<const LtcRecord> ltc_table() { return table; }

Ltc ltc_at(double roughness, double eye_cosine) {
    const double row = std::clamp(roughness, 0.0, 1.0) * (ltc_edge - 1);
    const double column = std::sqrt(1 - std::clamp(eye_cosine, 0.0, 1.0)) * (ltc_edge - 1);
    const auto i = std::min(static_cast<std::uint32_t>(row), ltc_edge - 2);
    const auto j = std::min(static_cast<std::uint32_t>(column), ltc_edge - 2);
    Ltc sum{0, 0, 0, 0, 0, 0, 0};
    for (const std::uint32_t corner : {0u, 1u, 2u, 3u}) {
        const std::uint32_t y = i + corner / 2, x = j + corner % 2;
        const double weight = (1 - std::abs(row - y)) * (1 - std::abs(column - x));
        const LtcRecord& r = table[y * ltc_edge + x];
        sum.m11 += weight * double(r.m11);
        sum.m13 += weight * double(r.m13);
        sum.m22 += weight * double(r.m22);
        sum.m31 += weight * double(r.m31);
        sum.m33 += weight * double(r.m33);
        sum.albedo += weight * double(r.albedo);
        sum.fresnel += weight * double(r.fresnel);
    }
    return sum;
}

glm::dvec3 reflectance(const Ltc& lobe, LightingModel model, const glm::dvec3& f0) {
    const glm::dvec3 once = f0 * (lobe.albedo - lobe.fresnel) + lobe.fresnel;
    return model == LightingModel::multiscatter_ggx ? once * (1. + f0 * (1 / lobe.albedo - 1)) : once;
}

}  // namespace strata
