// Volumes whose slices hold products and not sums: layers of an array that triangles are blended into, a whole one into one slice
// (docs/algorithms/transparency.md 6.4). The products become the codes that atomics would have added up.
#pragma once

#include "passes/transparency/voxel/volume/volume.h"

namespace strata::transparency {

/// Multiplies the low frame's transmittances into the layers of an array of `bits` and writes them into the volume as words.
void splat_factors(Graph&, const FrameImages& low, const VoxelParams&, Volume&);

}  // namespace strata::transparency
