// How far ambient occlusion is from traced visibility, and what that does to ambient light.
#pragma once

#include <vector>

#include "passes/metric.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// Of samples with a surface: the root mean square error of the occlusion image, its largest, its mean (result - truth; above 0
/// it is too bright), and the error of the hemisphere's light after occlusion relative to that light's root mean square.
/// Without the images of surfaces, every sample counts and light is not judged.
std::vector<Metric> occlusion_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
