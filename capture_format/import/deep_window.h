// A rectangle of a deep image's pixels.
#pragma once

#include <cstdint>

namespace strata {

/// Pixels; x grows to the right and y downwards, as OpenEXR counts them.
struct DeepWindow {
    std::int32_t x = 0, y = 0;
    std::uint32_t width = 0, height = 0;
};

/// Whether they have a pixel in common.
inline bool overlap(const DeepWindow& a, const DeepWindow& b) {
    return std::int64_t{a.x} < std::int64_t{b.x} + b.width && std::int64_t{b.x} < std::int64_t{a.x} + a.width &&
           std::int64_t{a.y} < std::int64_t{b.y} + b.height && std::int64_t{b.y} < std::int64_t{a.y} + a.height;
}

}  // namespace strata
