// The volume of voxels as steps of the graph: which slices it has, cleared, splatted into, integrated.
#pragma once

#include <cstdint>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/transparency/voxel/voxel.shared.h"

namespace strata::transparency {

struct Volume {
    Image voxels;     ///< r32ui: layer = word of a column; channels one below the other
    Buffer overflow;  ///< a word per column; one word where nothing notes overflows
    Buffer warp;      ///< WarpHeader and its table; a header of zeros where nothing is adaptive
    Buffer tiles;     ///< a bit per tile and word of its columns; one word where nothing is skipped
    std::uint32_t divisor = 8, field_bits = 8;
    VoxelPush push;
};

/// Holds inclusive sums instead of extinction, where a tile uses a slice; anything elsewhere.
Volume integrated_volume(Graph&, const FrameImages&, const VoxelParams&);

/// To a step that reads the integral at fragments' depths.
DrawPass& read_volume(DrawPass&, const Volume&, const VoxelParams&);

/// One of view_zero_depth, view_overflow, view_thickness.
Image volume_view(Graph&, const FrameImages&, const VoxelParams&, std::uint32_t shown);

}  // namespace strata::transparency
