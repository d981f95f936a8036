// The filter kernel in double: the mean of (taps - 1)^2 bilinear taps, gathered texel by texel.
#include "passes/shadows/pcf/kernel.h"

#include <cmath>

namespace strata::shadows {

namespace {

// Depth of a texel; what lies outside the map, or was never drawn, is infinitely far from the light.
double map_depth(const ReferenceImage& maps, const Lookup& at, std::int64_t x, std::int64_t y) {
    if (x < 0 || y < 0 || x >= at.size || y >= at.size) return 0;
    return maps.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), at.layer).x;
}

// Of the texel `tap` places after the kernel's first one, along one axis: how many bilinear taps touch it, and by how much.
double weight(std::int64_t tap, std::int64_t taps, double fraction) {
    double sum = 0;
    if (tap < taps - 1) sum += 1 - fraction;
    if (tap > 0) sum += fraction;
    return sum;
}

}  // namespace

Filtered filter_map(const ReferenceImage& maps, const Lookup& at, std::int64_t taps) {
    const glm::dvec2 corner = glm::floor(at.u - 0.5);
    const glm::dvec2 fraction = glm::floor((at.u - 0.5 - corner) * 256.0) / 256.0;
    const auto first_x = static_cast<std::int64_t>(corner.x) - (taps / 2 - 1);
    const auto first_y = static_cast<std::int64_t>(corner.y) - (taps / 2 - 1);
    Filtered result{.lit = 0};
    for (std::int64_t y = 0; y < taps; ++y) {
        for (std::int64_t x = 0; x < taps; ++x) {
            const double share = weight(x, taps, fraction.x) * weight(y, taps, fraction.y);
            const double depth = map_depth(maps, at, first_x + x, first_y + y);
            if (at.depth >= depth) result.lit += share;
            if (share > 0 && depth > 0 && std::abs(at.depth - depth) <= at.doubt) result.undecided = true;
        }
    }
    result.lit /= double((taps - 1) * (taps - 1));
    return result;
}

}  // namespace strata::shadows
