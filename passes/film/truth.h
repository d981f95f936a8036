// The truth of film: the formulas of docs/algorithms/deferred.md 8.9 in double, with noise that is centered exactly and redrawn
// 24 times per second.
#pragma once

#include "passes/stages.h"

namespace strata {

ImageSet film_truth(const StageInput&);

}  // namespace strata
