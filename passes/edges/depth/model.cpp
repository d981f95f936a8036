// Four depths on a plane, in double.
#include <algorithm>
#include <cmath>

#include "passes/edges/depth/depth.shared.h"
#include "passes/edges/depth/depth_params.h"
#include "passes/edges/surface_tests_model.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::edges {
namespace {

// Three float additions round by at most 2^-24 of the largest depth each.
constexpr double rounding = 4 * 0x1p-24;

Verdict leaves_plane(const ReferenceImage& depth, std::uint32_t x, std::uint32_t y, double residual) {
    const auto at = [&](std::uint32_t sample) { return depth.at(x, y, sample).x; };
    const double apart = std::abs(at(0) + at(3) - at(1) - at(2)), largest = std::max({at(0), at(1), at(2), at(3)});
    if (std::abs(apart - residual * largest) <= rounding * largest) return Verdict::undecided;
    return verdict_of(apart > residual * largest);
}

}  // namespace

ImageSet depth_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<DepthParams>();
    ModelLimits limits{.normal_angle = params.normal_angle, .color_step = params.color_step};
    if (params.paired_with == depth_and_normal || params.paired_with == depth_and_both) limits.tests |= test_normal;
    if (params.paired_with == depth_and_material || params.paired_with == depth_and_both) limits.tests |= test_material;
    return marked(input, [&](std::uint32_t x, std::uint32_t y) {
        const Verdict by_surfaces = surface_verdict(input, x, y, limits);
        if (by_surfaces == Verdict::edge || covered_samples(input, x, y) == 0) return by_surfaces;
        const Verdict by_depth = leaves_plane(input.before.at("depth_layers"), x, y, params.residual);
        return by_depth == Verdict::plain ? by_surfaces : by_depth;
    });
}

}  // namespace strata::edges
