// The parameters that a debug view is read with: its help has their names in backticks.
#pragma once

#include <string_view>
#include <vector>

namespace strata {

struct DebugView;  // passes/debug_views.h
struct Param;      // passes/settings.h
struct Technique;  // passes/technique.h

/// Whether the view's help names the parameter, as in "texels of pyramid level `level`". Words that are a parameter's name by
/// coincidence ("before distortion") are none.
bool names_param(const DebugView&, std::string_view param);

std::vector<const Param*> params_of(const Technique&, const DebugView&);

}  // namespace strata
