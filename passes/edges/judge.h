// Judges an edge mask: a missed edge is shaded wrongly, a needless one costs three more shadings.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

std::vector<Metric> edges_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
