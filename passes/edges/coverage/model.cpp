// Partial coverage by the rasterizer in double: which samples of a pixel a triangle covers, and whether one of them shows it.
#include <algorithm>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/edges/coverage/clip_seams_model.h"
#include "passes/edges/coverage/coverage_params.h"
#include "passes/edges/coverage/masks_model.h"
#include "passes/edges/edges.shared.h"
#include "passes/edges/surface_tests_model.h"
#include "passes/reference/fragments.h"
#include "passes/reference/raster.h"
#include "passes/reference/shade.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::edges {
namespace {

// A float that filters a texture is this near at least (passes/reference/visible_points.cpp).
constexpr double alpha_rounding = 1.0 / 2048;

struct CoveredPixel {
    std::vector<Covering> triangles;
    /// Rounding decides on which side of a triangle a sample lies. Of seams inside meshes, too, which are undecided to nobody
    /// else: there either triangle gives the sample the same surface.
    bool undecided = false;

    void add(const Frame& frame, const RasterPoint& point) {
        undecided = undecided || point.undecided;
        if (!point.covered) return;
        const auto is_same = [&](const Covering& c) { return c.draw == point.draw && c.triangle == point.triangle; };
        auto found = std::ranges::find_if(triangles, is_same);
        if (found == triangles.end()) found = triangles.insert(found, begun(frame, point));
        found->covered |= 1u << point.sample;
        found->depth[point.sample] = point.depth;
        found->tolerance[point.sample] = depth_tolerance(point);
    }

private:
    static Covering begun(const Frame& frame, const RasterPoint& point) {
        Covering covering{.draw = point.draw, .triangle = point.triangle};
        covering.is_masked = material_of(frame, point.draw)->alpha_mode == AlphaMode::mask;
        const double alpha = covering.is_masked ? surface_at(frame, point).alpha : 1;
        covering.is_fractional = alpha < 1 - alpha_rounding;
        return covering;
    }
};

/// In the order of pixels, row by row.
std::vector<CoveredPixel> covered_pixels(const Frame& frame) {
    std::vector<CoveredPixel> all(std::size_t(frame.view.width) * frame.view.height);
    rasterize(frame, opaque_draws(frame), {.shade_at = ShadeAt::pixel_center, .near_misses = true, .near_seams = true},
              [&](const RasterPoint& point) { all[std::size_t(point.y) * frame.view.width + point.x].add(frame, point); });
    return all;
}

/// Whether a sample's nearest triangle leaves a part of the pixel uncovered.
Verdict covers_partly(const std::vector<Covering>& here, const RasterPoint& nearest, std::uint32_t samples) {
    if (nearest.undecided) return Verdict::undecided;
    for (const Covering& covering : here)
        if (covering.draw == nearest.draw && covering.triangle == nearest.triangle)
            return verdict_of(covering.covered != (1u << samples) - 1);
    return Verdict::plain;  // the sky
}

/// Before tests of surfaces.
Verdict coverage_verdict(const std::vector<Covering>& here, const VisiblePoints& visible, glm::uvec2 pixel) {
    Verdict verdict = Verdict::plain;
    for (std::uint32_t sample = 0; sample < visible.samples; ++sample) {
        const Verdict one = covers_partly(here, visible.points[visible.index(pixel.x, pixel.y, sample)], visible.samples);
        if (one == Verdict::undecided) return one;
        if (one == Verdict::edge) verdict = one;
    }
    return verdict;
}

}  // namespace

ImageSet coverage_model(const StageInput& input, const Settings& settings) {
    if (input.frame.view.samples < 2) return {};
    const auto params = settings.as<CoverageParams>();
    ModelLimits limits{.depth_step = params.depth_step, .color_step = params.color_step};
    if (params.with_tests == coverage_and_depth || params.with_tests == coverage_and_both) limits.tests |= test_depth;
    if (params.with_tests == coverage_and_material || params.with_tests == coverage_and_both) limits.tests |= test_material;
    const std::vector<CoveredPixel> covered = covered_pixels(input.frame);
    const bool by_depth = has_masks(input.frame);
    const VisiblePoints visible = visible_points(input.frame, opaque_draws(input.frame));
    const ClipSeams seams = clip_seams(input.frame);
    return marked(input, [&](std::uint32_t x, std::uint32_t y) {
        const CoveredPixel& here = covered[std::size_t(y) * input.frame.view.width + x];
        if (here.undecided) return Verdict::undecided;
        Verdict by_coverage =
            by_depth ? verdict_by_depth(here.triangles, input, {x, y}) : coverage_verdict(here.triangles, visible, {x, y});
        for (std::uint32_t sample = 0; sample < visible.samples; ++sample) {
            const RasterPoint& nearest = visible.at(x, y, sample);
            // A piece of a triangle that covers the pixel may not; a piece of one that covers a part of it never does.
            if (by_coverage == Verdict::plain && seams.contains({x, y, nearest.draw, nearest.triangle}))
                by_coverage = Verdict::undecided;
        }
        if (by_coverage == Verdict::edge || limits.tests == 0) return by_coverage;
        const bool is_full = covered_samples(input, x, y) == input.frame.view.samples;
        const Verdict by_surfaces = is_full ? surface_verdict(input, x, y, limits) : Verdict::plain;
        return by_surfaces == Verdict::plain ? by_coverage : by_surfaces;
    });
}

}  // namespace strata::edges
