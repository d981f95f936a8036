// Judges an edge mask: a missed edge is shaded wrongly, a needless one costs three more shadings.
#pragma once

#include <vector>

#include "passes/stages.h"

namespace strata {

std::vector<Figure> edges_judge(const ImageSet& result, const ImageSet& truth, const StageInput&);

}  // namespace strata
