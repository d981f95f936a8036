// Light handed from cell to cell.
#pragma once

#include <cstdint>
#include <functional>

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

/// Steps that a grid takes.
std::uint32_t iterations(const LpvParams&, const DeviceGrid&);

/// Fixes and binds what propagation/faces.glsl and occlusion/links.glsl declare, the links as a step from 0 on has them. Without
/// links nothing is read of the buffer that stands for them.
ComputeStep fix_faces(ComputeStep, const LpvParams&);
ComputeStep fix_links(ComputeStep, const DeviceGrid&, std::uint32_t step);

/// Finds the links, and calls look(step, light) with what the cells hold before each step and after the last.
void propagate(
    Graph&, const FrameImages&, const LpvParams&, DeviceGrid&,
    const std::function<void(std::uint32_t step, const Buffer& light)>& look = [](std::uint32_t, const Buffer&) {});

}  // namespace strata::indirect
