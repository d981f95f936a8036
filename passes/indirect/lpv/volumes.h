// The light volumes of a frame as steps of the graph.
#pragma once

#include <vector>

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

/// Width of cells, as a multiple of the recorded one.
double cell_scale(const LpvParams&);

/// Whether blockers stop light between the cells of a grid; occlusion_*.
bool is_axial(const LightGrid&, std::uint32_t occlusion);

/// Empty.
std::vector<DeviceGrid> make_grids(Graph&, const FrameImages&, const LpvParams&);

/// Injected and propagated, all of it in this frame: for views, which change nothing that frames leave to the next.
std::vector<DeviceGrid> lit_grids(Graph&, const FrameImages&, const LpvParams&);

/// The grids that surfaces and transparent fragments in view may read: lit_grids(), or with relight_changed what earlier frames
/// left where nothing changed. Once per frame.
std::vector<DeviceGrid> shown_grids(Graph&, const FrameImages&, const LpvParams&);

}  // namespace strata::indirect
