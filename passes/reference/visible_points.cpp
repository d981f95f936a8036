// The nearest surface under every sample, with what rounding could change about it.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/reference/mask_test.h"
#include "passes/reference/raster.h"
#include "passes/reference/surfaces.h"

namespace strata {
namespace {

// A masked alpha this near to its cutoff depends on how a float filters: an eighth of an 8-bit step.
constexpr double alpha_rounding = 1.0 / 2048;

// A point of a sample, and whether the alpha test may cut it.
struct Contender {
    RasterPoint point{.draw = no_index};
    bool may_be_cut = false;
};

double reach(const RasterPoint& point) { return point.depth + depth_tolerance(point); }
double safe_depth(const RasterPoint& point) { return point.depth > 0 ? point.depth - depth_tolerance(point) : 0; }

// The nearest point so far, and the others that may be the nearest.
struct Nearest {
    Contender first;
    double certain = 0;  ///< something surely covers the sample at this depth or nearer
    std::vector<Contender> rivals;
};

void add(Nearest& nearest, Contender contender) {
    if (!contender.point.undecided) nearest.certain = std::max(nearest.certain, safe_depth(contender.point));
    if (contender.point.covered && contender.point.depth >= nearest.first.point.depth) std::swap(nearest.first, contender);
    if (contender.point.draw != no_index && reach(contender.point) >= nearest.certain) nearest.rivals.push_back(contender);
}

// Leaves the rivals that may be in front of all that is certain.
void drop_hidden_rivals(Nearest& nearest) {
    if (nearest.rivals.empty()) return;
    std::vector<Contender> all = nearest.rivals;
    all.push_back(nearest.first);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!all[i].may_be_cut && !all[j].may_be_cut && share_a_side(all[i].point, all[j].point))
                nearest.certain = std::max(nearest.certain, std::min(safe_depth(all[i].point), safe_depth(all[j].point)));
    std::erase_if(nearest.rivals, [&](const Contender& rival) { return reach(rival.point) < nearest.certain; });
}

// Applies the alpha test: whether the point is there at all, and whether that is certain.
bool survives_mask(const Frame& frame, const MaskTest& test, Contender& contender) {
    RasterPoint& point = contender.point;
    const Material* material = material_of(frame, point.draw);
    if (material == nullptr || material->alpha_mode != AlphaMode::mask) return true;
    const MaskCover cover = test(point);
    if (cover == MaskCover::kept || cover == MaskCover::cut) return cover == MaskCover::kept;
    contender.may_be_cut = point.undecided = true;
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
    std::vector<std::vector<RasterPoint>> rivals_of_row(view.height);
    oneapi::tbb::parallel_for(std::uint32_t{0}, view.height, [&](std::uint32_t y) {
        std::vector<Nearest> row(std::size_t(view.width) * view.samples);
        raster.row(y, options, [&](const RasterPoint& point, const RasterTriangle&) {
            Contender contender{point};
            if (survives_mask(frame, test, contender)) add(row[std::size_t(point.x) * view.samples + point.sample], contender);
        });
        for (std::uint32_t slot = 0; slot < row.size(); ++slot) {
            Nearest& nearest = row[slot];
            drop_hidden_rivals(nearest);
            RasterPoint point = nearest.first.point;
            point.x = slot / view.samples;
            point.y = y;
            point.sample = slot % view.samples;
            const bool may_be_none = nearest.certain == 0 && (point.draw != no_index || !nearest.rivals.empty());
            point.undecided = !nearest.rivals.empty() || may_be_none;
            visible.points[visible.index(point.x, y, point.sample)] = point;
            for (const Contender& rival : nearest.rivals) rivals_of_row[y].push_back(rival.point);
            if (may_be_none && point.draw != no_index)
                rivals_of_row[y].push_back({.x = point.x, .y = y, .sample = point.sample, .draw = no_index});
        }
    });
    for (const std::vector<RasterPoint>& rivals : rivals_of_row) std::ranges::copy(rivals, std::back_inserter(visible.rivals));
    std::ranges::stable_sort(visible.rivals, {}, [&](const RasterPoint& p) { return visible.index(p.x, p.y, p.sample); });
    return visible;
}

}  // namespace strata
