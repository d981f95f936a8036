// The light volumes of a frame as steps of the graph.
#pragma once

#include <vector>

#include "passes/indirect/lpv/device_grid.h"

namespace strata::indirect {

/// Empty.
std::vector<DeviceGrid> make_grids(Graph&, const FrameImages&, const LpvParams&);

/// Injected and propagated.
std::vector<DeviceGrid> lit_grids(Graph&, const FrameImages&, const LpvParams&);

}  // namespace strata::indirect
