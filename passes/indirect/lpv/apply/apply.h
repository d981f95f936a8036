// What surfaces read of grids.
#pragma once

#include <span>

#include "passes/indirect/lpv/device_grid.h"

namespace strata::indirect {

/// The blockers near each macro-cell of a grid: what see_light() hands on. Nothing where no tap is asked about.
void find_macro_cells(Graph&, const FrameImages&, const LpvParams&, DeviceGrid&);

ApplyPush apply_push(const DeviceGrid&);

/// To a step whose shader includes passes/indirect/lpv/apply/taps.glsl.
ComputePass see_light(ComputePass, const FrameImages&, const LpvParams&, const DeviceGrid&);

/// Irradiance / pi of every sample. What a point takes of the first grid that holds it lies over what it takes of those after it.
Image apply(Graph&, const FrameImages&, const LpvParams&, std::span<const DeviceGrid>);

/// Leaves the grids to later stages (FrameImages::volume_light). Nothing runs where no later stage reads them.
void hand_on(Graph&, FrameImages&, const LpvParams&, std::span<const DeviceGrid>);

}  // namespace strata::indirect
