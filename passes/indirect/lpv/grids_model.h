// Where the grids of light propagation volumes lie, in double (docs/algorithms/lighting.md 5.7): a fixed local volume is one grid
// around its center, a cascaded global volume one grid per cascade around the eye. All in world space, along the world's axes.
#pragma once

#include <vector>

#include "passes/indirect/cells_model.h"

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::indirect::in_double {

/// Local volumes in the order of the frame, then the cascades of global volumes, finest first.
/// Cells so many times as wide as recorded, in the recorded extent.
std::vector<Grid> grids(const Frame&, double cell_scale = 1);

}  // namespace strata::indirect::in_double
