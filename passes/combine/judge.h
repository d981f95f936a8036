// How far the developed picture is from the formulas, and the linear one where it can be seen.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// First the root mean square error of display light (0..1).
std::vector<Metric> combine_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
