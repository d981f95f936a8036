// How far a picture through the lens is from its truth.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// First the root mean square error of display light, as this frame's exposure and tone curve show both. Then radiance, and the
/// exposure's error in stops.
std::vector<Metric> lens_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
