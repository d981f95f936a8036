// What is in the volume, as pictures and as numbers.
#pragma once

#include <vector>

#include "passes/debug_views.h"
#include "passes/graph/step.h"
#include "passes/transparency/voxel/views/views.shared.h"
#include "passes/transparency/voxel/voxel_params.h"

namespace strata::transparency {

/// One of the constants view_... of views.shared.h.
Image volume_view(Graph&, const FrameImages&, const VoxelParams&, std::uint32_t shown);

/// The depth warp as a curve.
Image warp_view(Graph&, const FrameImages&, const VoxelParams&);

/// What the nearest fragment of a pixel reads in front of itself.
Image self_occlusion_view(Graph&, const FrameImages&, const VoxelParams&);

/// Slices, the runs that the warp leaves, what is in virtual ones, overflows, and how coarse all that is.
std::vector<DebugTable> voxel_tables();

}  // namespace strata::transparency
