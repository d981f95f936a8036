// How far a decoded G-buffer is from the surfaces it stands for.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata {

/// First the root mean square angle between normals, in degrees. Samples whose coverage hangs on rounding do not count.
std::vector<Figure> gbuffer_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
