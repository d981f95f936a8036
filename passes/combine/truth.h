// The truth of combining: the formulas of docs/algorithms/deferred.md 8 in double, every sample with its own light.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// display; and color, where nothing transparent is drawn over it afterwards.
ImageSet combine_truth(const StageInput&);

}  // namespace strata
