// Where nothing is seen any more, tile by tile, and opaque depth that says so: what is behind is not shaded
// (docs/algorithms/transparency.md 6.9). The picture does not change by a bit: a fragment whose T(z) is 0 in all channels adds
// nothing, drawn or not.
#pragma once

#include "passes/transparency/voxel/volume/volume.h"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/voxel_params.h"

namespace strata {

class Features;  // capture_format/frame_features.h

}  // namespace strata

namespace strata::transparency {

/// The frame's opaque depth, nearer where nothing is seen in front of it: a copy, or images.depth itself with culling_off, where
/// nothing is drawn at the frame's extent, and where interfaces would be hidden, which are tested behind what they are seen
/// before.
Image culled_depth(Graph&, const FrameImages&, const Volume&, const VoxelParams&);

/// Whether the volume is made before the opaque draws: where that is asked for, something is culled, no particle fades by opaque
/// depth nor shows distortion what is opaque elsewhere, and no interface is tested against what was hidden.
bool is_made_before_opaque(const VoxelParams&, const Features&);

/// The same depth before the opaque draws: they go into it, and where nothing is seen of them they are not shaded, either.
Image depth_to_draw_opaque_into(Graph&, const FrameImages&, const Volume&, const VoxelParams&);
/// That depth, after the opaque draws.
Image earlier_culled_depth(const Graph&);

/// The depth of each pixel's tile in meters, 0 where all that is drawn is seen.
Image zero_depth_view(Graph&, const FrameImages&, const VoxelParams&);

/// Fragments per pixel that culling keeps from being shaded, and samples of whose opaque surface nothing is seen, in red and
/// green.
Image culled_view(Graph&, const FrameImages&, const VoxelParams&);

}  // namespace strata::transparency
