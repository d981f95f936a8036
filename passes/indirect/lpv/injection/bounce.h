// What surfaces reflect of the light that grids brought to them.
#pragma once

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

/// A grid into which the surfaces reflect what they receive of a lit one; its light is yet to be propagated.
DeviceGrid reflected(Graph&, const FrameImages&, const LpvParams&, const DeviceGrid& lit);

}  // namespace strata::indirect
