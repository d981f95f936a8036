// How far a decoded G-buffer is from the surfaces it stands for.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// First the root mean square angle between normals, in degrees. Undecided samples do not count (settle_gbuffer).
std::vector<Metric> gbuffer_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

/// An undecided sample becomes that of the surfaces it may show that is nearest to the result in all it stores. The bound is of
/// the normal angle rms: the largest angle between two such surfaces.
Metric settle_gbuffer(const ImageSet& result, ImageSet& truth);

}  // namespace strata
