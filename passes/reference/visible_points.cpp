// The nearest surface under every sample, with what rounding could change about it.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/mask_test.h"
#include "passes/reference/raster.h"
#include "passes/reference/surfaces.h"

namespace strata {
namespace {

// A masked alpha this near to its cutoff depends on how a float filters: an eighth of an 8-bit step.
constexpr double alpha_rounding = 1.0 / 2048;

// The nearest point so far, and the nearest of those that may or may not be there.
struct Nearest {
    RasterPoint point{.draw = no_index};
    double doubtful = 0;  ///< nearest depth plus tolerance of an undecided point
    double second = 0;    ///< nearest depth plus tolerance of any covered point but `point`
};

void add(Nearest& nearest, const RasterPoint& point) {
    const double reach = point.depth + depth_tolerance(point);
    if (point.undecided) nearest.doubtful = std::max(nearest.doubtful, reach);
    if (!point.covered) return;
    RasterPoint& current = nearest.point;
    if (point.depth >= current.depth) {
        if (current.draw != no_index) nearest.second = std::max(nearest.second, current.depth + depth_tolerance(current));
        current = point;
    } else {
        nearest.second = std::max(nearest.second, reach);
    }
}

// Applies the alpha test: whether the point is there at all, and whether that is certain.
bool survives_mask(const Frame& frame, const MaskTest& test, RasterPoint& point) {
    const Material* material = material_of(frame, point.draw);
    if (material == nullptr || material->alpha_mode != AlphaMode::mask) return true;
    const MaskCover cover = test(point);
    if (cover == MaskCover::kept || cover == MaskCover::cut) return cover == MaskCover::kept;
    point.undecided = true;
    point.covered = point.covered && cover == MaskCover::maybe_kept;
    return true;
}

}  // namespace

MaskTest cutoff_test(const Frame& frame) {
    return [&frame](const RasterPoint& point) {
        const double alpha = surface_at(frame, point).alpha, cutoff = material_of(frame, point.draw)->mask_cutoff;
        if (std::abs(alpha - cutoff) > alpha_rounding) return alpha >= cutoff ? MaskCover::kept : MaskCover::cut;
        return alpha >= cutoff ? MaskCover::maybe_kept : MaskCover::maybe_cut;
    };
}

VisiblePoints visible_points(const Frame& frame, std::span<const std::uint32_t> draws, RasterOptions options) {
    return visible_points(frame, draws, options, cutoff_test(frame));
}

VisiblePoints visible_points(const Frame& frame, std::span<const std::uint32_t> draws, RasterOptions options,
                             const MaskTest& test) {
    const View& view = frame.view;
    const std::size_t samples = std::size_t(view.width) * view.height * view.samples;
    VisiblePoints visible{
        .width = view.width, .height = view.height, .samples = view.samples, .points = std::vector<RasterPoint>(samples)};
    const Raster raster(frame, draws);
    options.near_misses = true;
    oneapi::tbb::parallel_for(std::uint32_t{0}, view.height, [&](std::uint32_t y) {
        std::vector<Nearest> row(std::size_t(view.width) * view.samples);
        raster.row(y, options, [&](RasterPoint point, const RasterTriangle&) {
            if (survives_mask(frame, test, point)) add(row[std::size_t(point.x) * view.samples + point.sample], point);
        });
        for (std::uint32_t slot = 0; slot < row.size(); ++slot) {
            RasterPoint point = row[slot].point;
            point.x = slot / view.samples;
            point.y = y;
            point.sample = slot % view.samples;
            const double safe = point.depth - (point.depth > 0 ? depth_tolerance(point) : 0);
            point.undecided = row[slot].doubtful > safe || row[slot].second > safe;
            visible.points[visible.index(point.x, y, point.sample)] = point;
        }
    });
    return visible;
}

}  // namespace strata
