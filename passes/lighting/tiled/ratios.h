// What `strata bench` measures of tiled lighting.
#pragma once

#include <vector>

#include "passes/claims.h"

namespace strata::lighting {

std::vector<TimeRatio> tiled_ratios();

}  // namespace strata::lighting
