// The light volumes of a frame as steps of the graph.
#pragma once

#include <vector>

#include "passes/indirect/lpv/device_grid.h"

namespace strata::indirect {

/// Whether blockers stop light between the cells of a grid; occlusion_*.
bool is_axial(const LightGrid&, std::uint32_t occlusion);

/// Empty.
std::vector<DeviceGrid> make_grids(Graph&, const FrameImages&, const LpvParams&);

/// Injected and propagated.
std::vector<DeviceGrid> lit_grids(Graph&, const FrameImages&, const LpvParams&);

}  // namespace strata::indirect
