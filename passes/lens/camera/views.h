// What the effects of the lens do, as pictures and numbers. Only what is asked for is computed.
#pragma once

#include <vector>

#include "passes/debug_views.h"

namespace strata::lens {

std::vector<DebugView> camera_views();
std::vector<DebugTable> camera_tables();

}  // namespace strata::lens
