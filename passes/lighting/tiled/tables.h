// The numbers that the talk prints of tiled light culling, for `strata bench --tables`.
#pragma once

#include <vector>

#include "passes/claims.h"

namespace strata::lighting {

std::vector<PublishedTable> tiled_published_tables();

}  // namespace strata::lighting
