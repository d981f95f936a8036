// How far the reflected light of a technique is from every light on every sample.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// Root mean square error of radiance, the same relative to the truth's root mean square, and the worst channel.
std::vector<Metric> lighting_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
