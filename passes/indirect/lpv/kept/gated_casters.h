// What draws the maps of lights only where a grid needs them.
#pragma once

#include <map>
#include <span>

#include "passes/frame_images.h"
#include "passes/indirect/lpv/device_grid.h"

namespace strata::indirect {

/// Casters whose commands draw nothing in frames in which no grid that a light reaches is lit anew.
class GatedCasters {
public:
    GatedCasters(Graph& graph, const FrameImages& frame) : graph_(&graph), frame_(&frame) {}

    const FrameImages& frame() const { return *frame_; }
    /// The frame with the casters of a light that reaches these grids.
    FrameImages seen_by(std::span<DeviceGrid* const> grids);

private:
    Graph* graph_;
    const FrameImages* frame_;
    std::map<std::uint32_t, Buffer> commands_;  ///< by the grids' starting bits
};

}  // namespace strata::indirect
