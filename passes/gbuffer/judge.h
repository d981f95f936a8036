// How far a decoded G-buffer is from the surfaces it stands for.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// First the root mean square angle between normals, in degrees. Samples whose coverage hangs on rounding do not count.
std::vector<Metric> gbuffer_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
