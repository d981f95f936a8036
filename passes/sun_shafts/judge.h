// How far marched shafts are from the scattering integral.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// Relative root mean square error of radiance, the same absolute, the largest error, and the mean of result - truth relative to
/// the mean of the truth: below 0, the shafts are too dark.
std::vector<Metric> sun_shafts_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
