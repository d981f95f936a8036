// Judges visibility where it can be seen: on surfaces that face the light and lie in its reach.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

std::vector<Metric> shadows_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
