// The slice that a whole triangle is multiplied into: that of its corners' mean depth, depth offsets applied. A fragment cannot
// choose the layer it is drawn into, and the quads of particles, which face the eye, have one depth
// (docs/algorithms/transparency.md 6.4). A shader that includes this declares `VoxelPush push` in its push constants first. Where
// slices are adaptive and the center, which may be out of sight, is in none of them, the next in front has it.
#ifndef PASSES_TRANSPARENCY_VOXEL_TRIANGLE_SLICE_GLSL
#define PASSES_TRANSPARENCY_VOXEL_TRIANGLE_SLICE_GLSL
#include "passes/transparency/voxel/slices/depth_curve.glsl"

int slice_of_triangle(vec3 depths, uint layer) {
    if (layer > 0u) return slice_of_layer(layer);
    precise const float mean = (depths[0] + depths[1] + depths[2]) / 3.0;
    return max(physical_slice(int(slice_of_depth(mean))), 0);
}

#endif
