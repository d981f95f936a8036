// How far the developed picture is from the formulas, and the linear one where it can be seen.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata {

/// First the root mean square error of display light (0..1).
std::vector<Figure> combine_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
