// What surfaces reflect of the light that a grid brought to them, in double (docs/algorithms/lighting.md 5.7).
#pragma once

#include <span>
#include <vector>

#include "passes/indirect/lpv/injection/injection_model.h"
#include "passes/indirect/lpv/surfels/surfels_model.h"
#include "passes/indirect/reading_model.h"

namespace strata::indirect::in_double {

/// Each surfel within the grid receives the mean over the cells before it, and reflects its share.
std::vector<VirtualLight> reflected(std::span<const Surfel>, LitGrid);

}  // namespace strata::indirect::in_double
