// The parameters that a debug view is read with: its help has their names in backticks.
#pragma once

#include <string_view>
#include <vector>

#include "passes/technique.h"

namespace strata {

/// Whether the view's help names the parameter, as in "texels of pyramid level `level`". Words that are a parameter's name by
/// coincidence ("before distortion") are none.
bool names_param(const DebugView&, std::string_view param);

std::vector<const Param*> params_of(const Technique&, const DebugView&);

}  // namespace strata
