// Bilinear filtering in double.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace strata::transparency {

/// A pixel's center in an image of `extent`, 0 to 1 each way.
inline glm::dvec2 place_of(glm::uvec2 pixel, glm::uvec2 extent) { return (glm::dvec2(pixel) + .5) / glm::dvec2(extent); }

struct Tap {
    std::uint32_t x = 0, y = 0;
    double share = 0;
};

/// The four texels around a place (0 to 1 each way) of an image, edges held; their shares sum to 1.
inline std::array<Tap, 4> bilinear_taps(glm::dvec2 place, glm::uvec2 extent) {
    const glm::dvec2 at = place * glm::dvec2(extent) - .5, corner = glm::floor(at), share = at - corner;
    const auto held = [](double i, std::uint32_t count) { return std::uint32_t(std::clamp(i, 0., double(count - 1))); };
    std::array<Tap, 4> taps;
    for (int i = 0; i < 4; ++i) {
        const int dx = i % 2, dy = i / 2;
        taps[std::size_t(i)] = {held(corner.x + dx, extent.x), held(corner.y + dy, extent.y),
                                (dx ? share.x : 1 - share.x) * (dy ? share.y : 1 - share.y)};
    }
    return taps;
}

}  // namespace strata::transparency
