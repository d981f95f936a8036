// What light propagation volumes cost, as ratios, for `strata bench`.
#pragma once

#include <vector>

#include "passes/claims.h"

namespace strata::indirect {

std::vector<TimeRatio> lpv_ratios();

}  // namespace strata::indirect
