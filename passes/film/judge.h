// How far a picture on film is from its truth.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// First the root mean square error of display light. Then how much brighter or darker the whole picture is: grain must not be.
std::vector<Metric> film_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
