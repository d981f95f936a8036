#include "passes/transparency/adaptive/model.h"

#include <algorithm>
#include <limits>

#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/adaptive/adaptive_params.h"
#include "passes/transparency/functions/model.h"

namespace strata::transparency {
namespace {

// What the choices of `nodes` are called.
constexpr std::uint32_t node_counts_by_choice[] = {4, 8, 16};

double mean(glm::dvec3 v) { return (v.x + v.y + v.z) / 3; }

/// The step whose removal loses the least area, by index; neither the first nor the last.
std::size_t least_step(std::span<const CurveStep> curve) {
    std::size_t least = 1;
    double least_area = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
        const double drop = mean(curve[i - 1].transmittance) - mean(curve[i].transmittance);
        const double area = (curve[i].depth - curve[i - 1].depth) * drop;
        if (area < least_area) {
            least = i;
            least_area = area;
        }
    }
    return least;
}

}  // namespace

std::vector<CurveStep> adaptive_curve(std::span<const Fragment> fragments, std::uint32_t nodes) {
    std::vector<CurveStep> curve;
    for (const Fragment& f : fragments) {
        auto at = std::ranges::lower_bound(curve, f.depth, {}, &CurveStep::depth);
        const glm::dvec3 before = at == curve.begin() ? glm::dvec3(1) : std::prev(at)->transmittance;
        at = curve.insert(at, {f.depth, before});
        for (; at != curve.end(); ++at) at->transmittance *= f.transmittance;
        if (curve.size() <= nodes) continue;
        const auto removed = curve.begin() + static_cast<std::ptrdiff_t>(least_step(curve));
        std::prev(removed)->transmittance = removed->transmittance;
        curve.erase(removed);
    }
    return curve;
}

glm::dvec3 transmittance_at(std::span<const CurveStep> curve, double depth) {
    glm::dvec3 through(1);
    for (const CurveStep& step : curve)
        if (step.depth < depth) through = step.transmittance;
    return through;
}

ImageSet adaptive_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<AdaptiveParams>();
    const FunctionOfSample function = [&](std::span<const Fragment> fragments) -> Transmittance {
        return [curve = adaptive_curve(fragments, node_counts_by_choice[params.nodes])](const Fragment& f) {
            return transmittance_at(curve, f.depth);
        };
    };
    return function_model(input, params.accumulation, function);
}

}  // namespace strata::transparency
