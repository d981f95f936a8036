// The truth of film: the formulas of docs/algorithms/deferred.md 8.9 in double, with noise that is centered exactly and redrawn
// 24 times per second.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

ImageSet film_truth(const StageInput&);

}  // namespace strata
