// Slices of depth_curve.h in float. A shader that includes this declares `VoxelPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_DEPTH_CURVE_GLSL
#define PASSES_TRANSPARENCY_VOXEL_DEPTH_CURVE_GLSL
#include "passes/transparency/voxel/voxel.shared.h"

// Clamped to the volume.
float slice_of_depth(float z) {
    const float s = log2(1.0 + max(z, 0.0) * push.per_linear) * push.slices_per_log2;
    return min(s, float(push.slices) - end_margin);
}

float depth_of_slice(float s) { return (exp2(s / push.slices_per_log2) - 1.0) / push.per_linear; }

// dz / ds.
float thickness_at(float z) { return (z + 1.0 / push.per_linear) * log(2.0) / push.slices_per_log2; }

#endif
