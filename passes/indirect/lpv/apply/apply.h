// What surfaces read of grids.
#pragma once

#include <span>

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

/// The blockers near each macro-cell of a grid: what see_light() hands on. Nothing where no tap is asked about.
void find_macro_cells(Graph&, const FrameImages&, const LpvParams&, DeviceGrid&);

ApplyPush apply_push(const DeviceGrid&);

/// 1 where cells that a blocker hides from a surface are left out.
std::uint32_t asks_taps(const LpvParams&, const DeviceGrid&);

/// Binds what passes/indirect/lpv/apply/taps.glsl declares.
template <typename Builder>
Builder& bind_taps(Builder&& builder, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    return fix_blockers(builder, frame)
        .loads("Total", grid.total)
        .loads("MacroCells", grid.macro_cells ? grid.macro_cells : grid.total)
        .fixes("has_macro_cells", grid.macro_cells ? 1u : 0u)
        .fixes("cell_storage", grid.storage)
        .fixes("channels", grid.channels)
        .fixes("reading", params.reading)
        .fixes("asks_taps", asks_taps(params, grid));
}

/// The same and the G-buffer, to a step over pixels.
ComputeStep see_light(ComputeStep, const FrameImages&, const LpvParams&, const DeviceGrid&);

/// Irradiance / pi of every sample. What a point takes of the first grid that holds it lies over what it takes of those after it.
Image apply(Graph&, const FrameImages&, const LpvParams&, std::span<const DeviceGrid>);

/// Leaves the grids to later stages (FrameImages::volume_light). Nothing runs where no later stage reads them.
void hand_on(Graph&, FrameImages&, const LpvParams&, std::span<const DeviceGrid>);

}  // namespace strata::indirect
