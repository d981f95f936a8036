// How far wet surfaces are from what rain makes of them.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// First the root mean square error of base color, then those of roughness and normals, then the share of samples that are wet
/// where they should be dry, or dry where they should be wet. Only samples with a surface count.
std::vector<Metric> rain_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
