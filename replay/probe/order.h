// The order in which a probe's techniques are listed.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "replay/probe/probe.h"

namespace strata {

/// Curves by their error over the logarithm of depth, least first; those without a curve last.
inline std::vector<const ProbeCurve*> best_first(const Probe& probe) {
    std::vector<const ProbeCurve*> order;
    for (const ProbeCurve& curve : probe.curves) order.push_back(&curve);
    std::ranges::stable_sort(order, std::ranges::less{}, [](const ProbeCurve* curve) {
        return std::pair(!curve->not_supported.empty(), curve->metrics.l1_logarithmic);
    });
    return order;
}

/// "frame 0, pixel (10, 20), sample 0".
inline std::string place_of(const Probe& probe) {
    return fmt::format("frame {}, pixel ({}, {}), sample {}", probe.frame, probe.at.x, probe.at.y, probe.at.sample);
}

}  // namespace strata
