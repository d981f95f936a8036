// What `strata bench` measures of tiled lighting.
#pragma once

#include <vector>

#include "passes/technique.h"

namespace strata::lighting {

std::vector<TimeRatio> tiled_ratios();

}  // namespace strata::lighting
