// A grid of light on the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/indirect/lpv/light_eye.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/scene/light_grids.h"

namespace strata::indirect {

inline constexpr std::uint64_t channel_bytes = 4 * sizeof(float), half_channel_bytes = 4 * 2;

struct DeviceGrid {
    LightGrid grid;
    GridPlace place;           ///< as the frame's eye has it: of what surfaces and views read
    GridPlace lit_place;       ///< as `eye` has it: of what lights it
    LightEye eye;              ///< the same for all grids of a frame
    bool has_links = false;    ///< blockers stop light between cells
    bool is_fuzzy = false;     ///< surfaces do, from the second step on
    double fixed_one = 1;      ///< 1 in the fixed point of its sums: a power of two
    std::uint32_t number = 0;  ///< in the order of light_grids()
    Buffer sums;               ///< what is injected, in fixed point
    Buffer links;              ///< occlusion/links.comp; none without has_links
    Buffer later_links;        ///< occlusion/fuzzy.comp, of all steps but the first; none without is_fuzzy
    Buffer total;              ///< all that cells ever held (stored_cells.glsl)
    Buffer macro_cells;        ///< apply/macro_cells.comp; none: taps ask all blockers
    // Of a grid that is kept over frames (kept/); none of them otherwise.
    Buffer gates;                           ///< how many groups its steps have in this frame: three words a gate of lpv.shared.h
    Buffer starting;                        ///< bits of the grids that are lit anew in this frame (kept.shared.h)
    Buffer even, odd;                       ///< light of steps (stored_cells.glsl), where a later frame goes on with it
    std::size_t bounce = 1;                 ///< of the light in it
    Buffer scale;                           ///< a float: its fixed_one, where that is known on the device alone
    std::uint32_t storage = storage_float;  ///< of the cells of total, even and odd
    std::uint32_t channels = color_channels;

    std::uint32_t cells() const { return grid.cells.x * grid.cells.y * grid.cells.z; }
    std::uint64_t all_channels() const { return std::uint64_t{cells()} * channels; }
    /// Sizes of `sums`, of `total`, and of a step's light.
    std::uint64_t sums_bytes() const { return all_channels() * channel_bytes; }
    std::uint64_t total_bytes() const {
        return storage == storage_half ? unit_words * sizeof(uint) + all_channels() * half_channel_bytes
                                       : all_channels() * channel_bytes;
    }
    std::uint64_t step_bytes() const {
        return all_channels() * (storage == storage_half ? half_channel_bytes : channel_bytes + sizeof(float));
    }
    std::string name(const char* what) const {
        return fmt::format("{} {}{}", what, number, bounce > 1 ? fmt::format(", bounce {}", bounce) : "");
    }
    /// One per cell.
    Extent threads() const { return {grid.cells.x, grid.cells.y, grid.cells.z}; }
};

/// As many threads, or as many groups as the gate of a grid that is kept has in this frame.
ComputeStep gated(ComputeStep, const DeviceGrid&, std::uint32_t gate, Extent threads);

/// Fixes what passes/indirect/ways.glsl declares.
template <typename Builder>
Builder& fix_blockers(Builder&& builder, const FrameImages& frame) {
    return builder.fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .fixes("portal_count", static_cast<std::uint32_t>(frame.recorded->portals.size()));
}

}  // namespace strata::indirect
