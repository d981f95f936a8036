// Light volumes that are kept over frames: a grid is lit where what determines its light changed. The device compares hashes of
// it with those of the last time, so that a frame is declared the same whatever frames came before. What is remembered changes
// the cost and never the light.
#pragma once

#include <vector>

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

/// What a grid leaves to the next frame, beside its links.
struct KeptGrid {
    Buffer state, work;
    uvec2 lattice{0};  ///< GridKeys::lattice
    Buffer shown;      ///< as DeviceGrid::total: what surfaces read, where another is lit in slices
};
using KeptGrids = std::vector<KeptGrid>;

/// Decides what the grids have to do, gives them gates and what earlier frames left, and finds their links.
KeptGrids recall(Graph&, const FrameImages&, const LpvParams&, std::vector<DeviceGrid>&);

/// Of grids that are lit: surfaces read their `total`, and the next frame finds their state.
void keep(Graph&, std::vector<DeviceGrid>&, KeptGrids&);

}  // namespace strata::indirect
