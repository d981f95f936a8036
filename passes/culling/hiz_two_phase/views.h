// Pictures of the inside of two-phase occlusion culling.
#pragma once

#include <vector>

#include "passes/debug_views.h"

namespace strata::culling {

inline constexpr const char* pyramid_name = "hiz pyramid";
inline constexpr const char* draws_name = "hiz draws";

std::vector<DebugView> hiz_two_phase_views();

}  // namespace strata::culling
