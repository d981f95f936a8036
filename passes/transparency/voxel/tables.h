// The tables of times and memory that the talk prints of voxel transparency, for `strata bench --tables`.
#pragma once

#include <vector>

#include "passes/claims.h"

namespace strata::transparency {

std::vector<PublishedTable> voxel_published_tables();

}  // namespace strata::transparency
