// Judges visibility where it can be seen: on surfaces that face the light and lie in its reach.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata {

std::vector<Figure> shadows_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
