// The filter kernel in double: the mean of (taps - 1)^2 bilinear taps, gathered texel by texel.
#include "passes/shadows/kernel.h"

#include <algorithm>
#include <cmath>

namespace strata::shadows {

namespace {

// Of the texel `tap` places after the kernel's first one, along one axis: how many bilinear taps touch it, and by how much.
double weight(std::int64_t tap, std::int64_t taps, double fraction) {
    double sum = 0;
    if (tap < taps - 1) sum += 1 - fraction;
    if (tap > 0) sum += fraction;
    return sum;
}

// Of the receiver; beyond a face's edge as over its outermost texels.
double depth_over(const Lookup& at, glm::ivec2 texel) {
    const glm::ivec2 kept = at.is_face ? glm::clamp(texel, glm::ivec2(0), glm::ivec2(static_cast<int>(at.size) - 1)) : texel;
    const glm::dvec2 away = glm::dvec2(kept) + 0.5 - at.u;
    return at.depth + glm::dot(at.gradient, away) + std::max(glm::dot(at.rise, away) - at.risen, 0.0);
}

}  // namespace

double map_depth(const ReferenceImage& maps, const Lookup& at, glm::ivec2 texel) {
    const int last = static_cast<int>(at.size) - 1;
    const glm::ivec2 inside = glm::clamp(texel, glm::ivec2(0), glm::ivec2(last));
    if (inside != texel && !at.is_face) return 0;  // as where nothing was drawn: infinitely far from the light
    return maps
        .at(at.offset.x + static_cast<std::uint32_t>(inside.x), at.offset.y + static_cast<std::uint32_t>(inside.y), at.layer)
        .x;
}

Filtered filter_map(const ReferenceImage& maps, const Lookup& at, std::int64_t taps) {
    const glm::dvec2 corner = glm::floor(at.u - 0.5);
    const glm::dvec2 fraction = glm::floor((at.u - 0.5 - corner) * 256.0) / 256.0;
    const glm::ivec2 first = glm::ivec2(corner) - static_cast<int>(taps / 2 - 1);
    Filtered result{.lit = 0};
    for (std::int64_t y = 0; y < taps; ++y) {
        for (std::int64_t x = 0; x < taps; ++x) {
            const double share = weight(x, taps, fraction.x) * weight(y, taps, fraction.y);
            const glm::ivec2 texel = first + glm::ivec2(x, y);
            const double depth = map_depth(maps, at, texel), receiver = depth_over(at, texel);
            if (std::max(receiver, 0.0) >= depth) result.lit += share;
            if (share > 0 && depth > 0 && std::abs(receiver - depth) <= at.doubt) result.undecided = true;
        }
    }
    result.lit /= double((taps - 1) * (taps - 1));
    return result;
}

}  // namespace strata::shadows
