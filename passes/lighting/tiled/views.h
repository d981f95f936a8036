// Pictures and tables of what culling found in the tiles.
#pragma once

#include <vector>

#include "passes/debug_views.h"

namespace strata::lighting {

std::vector<DebugView> tiled_views();
std::vector<DebugTable> tiled_tables();

}  // namespace strata::lighting
