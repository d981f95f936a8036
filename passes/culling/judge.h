// Judges a visible set: draws wrongly hidden are holes in the picture, draws needlessly drawn only cost time.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

std::vector<Metric> culling_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
