// A grid of light on the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/scene/light_grids.h"

namespace strata::indirect {

struct DeviceGrid {
    LightGrid grid;
    GridPlace place;
    bool has_links = false;  ///< blockers stop light between cells
    double fixed_one = 1;    ///< 1 in the fixed point of its sums: a power of two
    std::size_t number = 0;  ///< in the order of light_grids()
    Buffer sums;             ///< what is injected: LightCell in fixed point
    Buffer links;            ///< occlusion/links.comp; none without has_links
    Buffer total;            ///< LightCell: all that cells ever held

    std::uint32_t cells() const { return grid.cells.x * grid.cells.y * grid.cells.z; }
    std::string name(const char* what) const { return fmt::format("{} {}", what, number); }
    /// One per cell.
    Extent threads() const { return {grid.cells.x, grid.cells.y, grid.cells.z}; }
};

/// Fixes what passes/indirect/ways.glsl declares.
ComputePass fix_blockers(ComputePass, const FrameImages&);

}  // namespace strata::indirect
