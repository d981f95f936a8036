// Judges a visible set: draws wrongly hidden are holes in the picture, draws needlessly drawn only cost time.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata {

std::vector<Figure> culling_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
