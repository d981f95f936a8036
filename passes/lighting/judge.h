// How far the reflected light of a technique is from every light on every sample.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata {

/// Root mean square error of radiance, the same relative to the truth's root mean square, and the worst channel.
std::vector<Figure> lighting_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
