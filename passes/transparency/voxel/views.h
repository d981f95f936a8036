// What is in the volume, as pictures and as numbers.
#pragma once

#include <vector>

#include "passes/technique.h"
#include "passes/transparency/voxel/voxel.shared.h"

namespace strata::transparency {

/// One of view_occupancy, view_saturation_depth, view_overflow, view_thickness.
Image volume_view(Graph&, const FrameImages&, const VoxelParams&, std::uint32_t shown);

/// The depth warp as a curve.
Image warp_view(Graph&, const FrameImages&, const VoxelParams&);

/// Slices, and the runs of slices that the warp leaves.
std::vector<DebugTable> voxel_tables();

}  // namespace strata::transparency
