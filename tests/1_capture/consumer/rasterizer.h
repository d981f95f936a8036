// The consumer's renderer: boxes into a color and a depth buffer of its own, on the CPU.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "consumer/crowd.h"

namespace consumer {

inline constexpr std::size_t picture_extent = 512;
/// Distance of the picture plane over half its height: a field of view of 90 degrees.
inline constexpr double zoom = 1;

class Rasterizer {
public:
    /// Draws a frame of the crowd, every body where it is placed; the screen's texels are shown by the last paint.
    void render(const Crowd&, const std::vector<Placement>&, const std::vector<std::uint32_t>& screen);
    const std::vector<std::uint32_t>& color() const { return color_; }

private:
    struct Corner {
        float x = 0, y = 0, depth = 0;  ///< pixels, 1 / meters
    };
    void box(const Body&, const Placement&, std::array<float, 3> paint);
    /// Color 0 shows the screen.
    void triangle(const std::array<Corner, 3>&, std::uint32_t color);

    std::vector<std::uint32_t> color_ = std::vector<std::uint32_t>(picture_extent * picture_extent);
    std::vector<float> depth_ = std::vector<float>(picture_extent * picture_extent);
    const std::vector<std::uint32_t>* screen_ = nullptr;
};

}  // namespace consumer
