// Transforms eight corners, fills twelve triangles, nearest wins.
#include "consumer/rasterizer.h"

#include <algorithm>
#include <cmath>

namespace consumer {
namespace {

constexpr float extent = static_cast<float>(picture_extent);

/// Corners of a face in turn; bit 0 of a corner is its side in x, bit 1 in y, bit 2 in z.
constexpr std::size_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

std::uint32_t packed(std::array<float, 3> paint, float light) {
    std::uint32_t color = 0xff000000;
    for (int i = 0; i < 3; ++i)
        color |= static_cast<std::uint32_t>(std::min(1.f, paint[static_cast<std::size_t>(i)] * light) * 255) << 8 * i;
    return color;
}

}  // namespace

void Rasterizer::render(const Crowd& crowd, const std::vector<Placement>& placements, const std::vector<std::uint32_t>& screen) {
    screen_ = &screen;
    std::ranges::fill(color_, 0xff402010u);
    std::ranges::fill(depth_, 0.f);
    std::array<std::array<float, 3>, paint_count> paints;
    for (std::size_t i = 0; i < paint_count; ++i) paints[i] = paint_at(i, crowd.time);
    for (std::size_t i = 0; i < placements.size(); ++i) box(crowd.bodies[i], placements[i], paints[crowd.bodies[i].paint]);
}

void Rasterizer::box(const Body& body, const Placement& placement, std::array<float, 3> paint) {
    const Vec3 half = half_size(body.shape);
    std::array<Corner, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        Vec3 p = placement[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double side = i >> axis & 1 ? half[axis] : -half[axis];
            for (std::size_t k = 0; k < 3; ++k) p[k] += side * placement[axis][k];
        }
        const double scale = zoom / p[2] * extent / 2;
        corners[i] = {static_cast<float>(extent / 2 + p[0] * scale), static_cast<float>(extent / 2 - p[1] * scale),
                      static_cast<float>(1 / p[2])};
    }
    const bool shows_screen = body.paint + 1 == paint_count;
    for (std::size_t face = 0; face < 6; ++face) {
        const Vec3& normal = placement[face / 2];
        const float light = .4f + .5f * static_cast<float>(std::abs(normal[1])) + .1f * static_cast<float>(face % 2);
        const std::uint32_t color = shows_screen ? 0 : packed(paint, light);
        const std::size_t* f = faces[face];
        triangle({corners[f[0]], corners[f[1]], corners[f[2]]}, color);
        triangle({corners[f[0]], corners[f[2]], corners[f[3]]}, color);
    }
}

void Rasterizer::triangle(const std::array<Corner, 3>& corner, std::uint32_t color) {
    const auto& [a, b, c] = corner;
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area >= 0) return;  // seen from behind
    const auto pixel = [](float x) { return static_cast<std::size_t>(std::clamp(x, 0.f, extent)); };
    const std::size_t left = pixel(std::min({a.x, b.x, c.x})), right = pixel(std::max({a.x, b.x, c.x}) + 1);
    const std::size_t top = pixel(std::min({a.y, b.y, c.y})), bottom = pixel(std::max({a.y, b.y, c.y}) + 1);
    for (std::size_t y = top; y < bottom; ++y) {
        for (std::size_t x = left; x < right; ++x) {
            const float px = static_cast<float>(x) + .5f, py = static_cast<float>(y) + .5f;
            const float wa = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
            const float wb = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
            const float depth = wa * a.depth + wb * b.depth + (1 - wa - wb) * c.depth;
            if (wa < 0 || wb < 0 || wa + wb > 1 || depth <= depth_[y * picture_extent + x]) continue;
            depth_[y * picture_extent + x] = depth;
            const std::uint32_t texel = (*screen_)[y % screen_extent * screen_extent + x % screen_extent];
            color_[y * picture_extent + x] = color == 0 ? texel : color;
        }
    }
}

}  // namespace consumer
