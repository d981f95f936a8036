// The ratios of times that the talk states of voxel transparency, for `strata bench`.
#pragma once

#include <vector>

#include "passes/claims.h"

namespace strata::transparency {

std::vector<TimeRatio> voxel_ratios();

}  // namespace strata::transparency
