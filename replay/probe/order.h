// The order in which a probe's techniques are listed.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "replay/measure/exact_below.h"
#include "replay/probe/probe.h"

namespace strata {

/// Curves by the error of what a display shows of the pixel, least first, those that are exact by their error over the logarithm
/// of depth; those without an error behind them, those without a curve last.
inline std::vector<const ProbeCurve*> best_first(const Probe& probe) {
    std::vector<const ProbeCurve*> order;
    for (const ProbeCurve& curve : probe.curves) order.push_back(&curve);
    std::ranges::stable_sort(order, std::ranges::less{}, [](const ProbeCurve* curve) {
        const double shown = curve->metrics.display_error.value_or(0);
        return std::tuple(!curve->not_supported.empty(), !curve->metrics.display_error, shown > exact_below ? shown : 0,
                          curve->metrics.l1_logarithmic);
    });
    return order;
}

/// "frame 0, pixel (10, 20), sample 0".
inline std::string place_of(const Probe& probe) {
    return fmt::format("frame {}, pixel ({}, {}), sample {}", probe.frame, probe.at.x, probe.at.y, probe.at.sample);
}

}  // namespace strata
