// The volume of voxels as steps of the graph: cleared, splatted into, integrated.
#pragma once

#include <cstdint>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/transparency/voxel/voxel.shared.h"

namespace strata::transparency {

struct Volume {
    Image voxels;     ///< r32ui: layer = word of a column; channels one below the other
    Buffer overflow;  ///< a word per column; one word where nothing notes overflows
    std::uint32_t divisor = 8, field_bits = 8;
    VoxelPush push;
};

/// Holds inclusive sums instead of extinction.
Volume integrated_volume(Graph&, const FrameImages&, const VoxelParams&);

/// One of view_zero_depth, view_overflow, view_thickness.
Image volume_view(Graph&, const FrameImages&, const VoxelParams&, std::uint32_t shown);

}  // namespace strata::transparency
