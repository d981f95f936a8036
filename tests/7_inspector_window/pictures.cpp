#include "tests/7_inspector_window/pictures.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace strata {
namespace {

std::array<int, 3> color_at(const HostImage& image, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = 4 * (std::size_t{y} * image.shape.extent.width + x);
    return {static_cast<int>(image.texels[at]), static_cast<int>(image.texels[at + 1]), static_cast<int>(image.texels[at + 2])};
}

}  // namespace

Differing differing(const HostImage& whole, int left, int top, const HostImage& part, const LeftOut& left_out) {
    Differing found;
    for (std::uint32_t y = 0; y < part.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < part.shape.extent.width; ++x) {
            const int at_x = left + static_cast<int>(x), at_y = top + static_cast<int>(y);
            if (left_out(at_x, at_y)) continue;
            const auto a = color_at(whole, static_cast<std::uint32_t>(at_x), static_cast<std::uint32_t>(at_y));
            const auto b = color_at(part, x, y);
            if (a == b) continue;
            if (found.pixels++ == 0)
                found.first = fmt::format("{} {}: {} is not {}", at_x, at_y, fmt::join(a, " "), fmt::join(b, " "));
        }
    return found;
}

}  // namespace strata
