#include "passes/transparency/voxel/sparse/sparse_model.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"
#include "passes/transparency/voxel/slices/depth_warp_model.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"
#include "passes/transparency/voxel/volume/column.h"

namespace strata::transparency {
namespace {

/// Words that a tile's column of so many slices may use: the last may be part empty.
std::uint32_t words_of(std::uint32_t slices, std::uint32_t per_word) { return (slices + per_word - 1) / per_word; }

/// Where the curve's finest slices a triangle is seen in end.
struct Stretch {
    double from, to;
};

/// The words that a tile uses at each resolution.
class TileWords {
public:
    TileWords(const VoxelParams& params, std::span<const std::uint32_t> slices)
        : slices_(slices), reach_(params.splatting == splatting_linear ? .5 : 0) {
        per_word_ = column_format(params).slices_per_word();
        for (const std::uint32_t count : slices) used_.emplace_back(words_of(count, per_word_));
    }
    void take(Stretch stretch) {
        for (std::size_t halvings = 0; halvings < used_.size(); ++halvings) {
            const auto word = [&](double s) {
                return static_cast<std::ptrdiff_t>(std::clamp(s, 0., slices_[halvings] - 1.)) / per_word_;
            };
            const double scale = std::exp2(-double(halvings));
            const auto first = used_[halvings].begin();
            std::fill(first + word(stretch.from * scale - reach_), first + word(stretch.to * scale + reach_) + 1, true);
        }
    }
    std::uint64_t used(std::size_t halvings) const {
        return static_cast<std::uint64_t>(std::ranges::count(used_[halvings], true));
    }

private:
    std::span<const std::uint32_t> slices_;
    double reach_;
    std::uint32_t per_word_;
    std::vector<std::vector<bool>> used_;
};

/// The rays of each tile, and a tenth of a column around it.
std::vector<RayRectangle> rays_of_tiles(const Frame& frame, Extent columns) {
    constexpr double rounding = .1;
    const glm::dvec2 pixels = glm::dvec2(frame.view.width, frame.view.height) / glm::dvec2(columns.width, columns.height);
    const Extent tiles = voxel_tiles(columns);
    std::vector<RayRectangle> rays;
    for (std::uint32_t i = 0; i < tiles.width * tiles.height; ++i) {
        const glm::dvec2 first = glm::dvec2(i % tiles.width, i / tiles.width) * double(tile_size);
        const glm::dvec2 low = (first - rounding) * pixels, high = (first + double(tile_size) + rounding) * pixels;
        const glm::dvec2 a(pixel_ray(frame, low.x, low.y)), b(pixel_ray(frame, high.x, high.y));
        rays.push_back({glm::min(a, b), glm::max(a, b)});
    }
    return rays;
}

/// Rays to the corners; all there are where some are not in front of the eye.
RayRectangle rays_around(const Corners& corners, double near) {
    RayRectangle around{glm::dvec2(HUGE_VAL), glm::dvec2(-HUGE_VAL)};
    for (const glm::dvec3& corner : corners) {
        if (corner.z < near) return {glm::dvec2(-HUGE_VAL), glm::dvec2(HUGE_VAL)};
        around = {glm::min(around.low, glm::dvec2(corner) / corner.z), glm::max(around.high, glm::dvec2(corner) / corner.z)};
    }
    return around;
}

bool overlap(const RayRectangle& a, const RayRectangle& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

struct Tile {
    RayRectangle rays;
    TileWords words;
};

struct MarkedDraw {
    std::uint32_t draw = 0;
    double half_deep = 0;  ///< meters by which its fragments reach out of its triangles
};

void take_draw(std::vector<Tile>& tiles, const Frame& frame, const DepthCurve& curve, const MarkedDraw& marked) {
    const auto [draw, half_deep] = marked;
    const DrawSpace space = draw_space(frame, draw);
    const double near = double(frame.view.near);
    for (std::uint32_t triangle = 0; triangle < triangle_count(frame, draw); ++triangle) {
        const Corners corners = view_corners(frame, space, draw, triangle);
        const RayRectangle around = rays_around(corners, near);
        const double offset = attributes_at(frame, draw, triangle, glm::dvec3(1, 0, 0)).depth_offset;
        const auto slice = [&](double z) { return curve.slice_of(std::max(z - offset, curve.nearest)); };
        for (Tile& tile : tiles) {
            if (!overlap(around, tile.rays)) continue;
            if (const auto depths = depths_within(corners, tile.rays, near))
                tile.words.take({slice(depths->nearest - half_deep), slice(depths->farthest + half_deep)});
        }
    }
}

}  // namespace

std::uint32_t sparse_halvings(const VoxelParams& params, const Frame& frame, Extent columns, std::uint32_t channels) {
    const DepthCurve curve = sparse_curve(params, voxel_range(params, frame), columns);
    const std::uint32_t per_word = column_format(params).slices_per_word();
    std::vector<std::uint32_t> slices{static_cast<std::uint32_t>(curve.slices)};
    while (words_of(slices.back(), per_word) > 1) slices.push_back(slices.back() / 2);
    std::vector<Tile> tiles;
    for (const RayRectangle& rays : rays_of_tiles(frame, columns)) tiles.push_back({rays, TileWords(params, slices)});
    for (const std::uint32_t draw : transparent_draws(frame))
        take_draw(tiles, frame, curve, {draw, thickness_of(params, frame, draw) / 2});
    std::uint32_t halvings = 0;
    const auto words = [&] {
        std::uint64_t sum = 0;
        for (const Tile& tile : tiles) sum += tile.words.used(halvings);
        return sum;
    };
    while (halvings + 1 < slices.size() && words() > pool_blocks(params) / channels) ++halvings;
    return halvings;
}

}  // namespace strata::transparency
