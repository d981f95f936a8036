// The depth warp as a curve: across, virtual slices from the nearest to the farthest; upwards, the physical slices up to each of
// them. Filled light where a slice is used and dark where it is not; a run begins at a green line and ends at a red one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/slices/depth_curve.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;

// Of the virtual slices a column of pixels stands for.
uint marks_between(uint first, uint end) {
    uint marks = 0u;
    for (uint slice = first; slice < end; ++slice) marks |= warp_entries[slice] & (warp_used | warp_begin | warp_end);
    return marks;
}

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy, extent = uvec2(imageSize(picture).xy);
    if (any(greaterThanEqual(pixel, extent))) return;
    const uint slices = virtual_slices(), first = pixel.x * slices / extent.x;
    const uint end = max((pixel.x + 1u) * slices / extent.x, first + 1u);
    const uint marks = adaptive != 0u ? marks_between(first, end) : warp_used;
    const uint below = (extent.y - pixel.y) * physical_slices() / extent.y;
    vec3 color = vec3(0.0);
    if (below <= uint(physical_slice(int(end) - 1) + 1)) color = (marks & warp_used) != 0u ? vec3(0.7) : vec3(0.2);
    else if ((marks & warp_begin) != 0u) color = vec3(0.0, 0.6, 0.1);
    else if ((marks & warp_end) != 0u) color = vec3(0.7, 0.1, 0.0);
    imageStore(picture, ivec3(pixel, 0), vec4(color, 1.0));
}
