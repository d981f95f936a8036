// What is in each slice, counted over all columns: tiles that use it, columns in which it holds something, and in which it is the
// first to overflow or to be full.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/views/views.shared.h"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/tiles.glsl"
#include "passes/transparency/voxel/volume/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform usampler2DArray voxels;
layout(set = 0, binding = 1, scalar) buffer Counts { SliceCounts counts[]; };

void count_tile(uvec2 tile) {
    for (uint slice = 0u; slice < physical_slices(); ++slice)
        if (is_used(tile, slice / slices_per_word)) atomicAdd(counts[slice].tiles, 1u);
}

void count_columns(uvec2 texel, uint channel) {
    uint in_front = 0u;
    for (uint slice = 0u; slice < physical_slices(); ++slice) {
        if (!is_used(texel / tile_size, slice / slices_per_word)) continue;
        const uint word = texelFetch(voxels, integral_place(texel, channel, slice), 0).r;
        const uint sum = integral_code(word, channel, slice);
        if (sum > in_front) atomicAdd(counts[slice].columns, 1u);
        in_front = sum;
        if (sum != full_integral()) continue;
        atomicAdd(counts[slice].saturated, 1u);
        return;
    }
}

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    const uint channel = gl_GlobalInvocationID.z;
    if (any(greaterThanEqual(texel, uvec2(push.width, push.height)))) return;
    if (gl_LocalInvocationIndex == 0u && channel == 0u) count_tile(gl_WorkGroupID.xy);
    const uint overflow = overflow_of(texel, channel);
    if (overflow != no_overflow) atomicAdd(counts[overflow].overflowed, 1u);
    count_columns(texel, channel);
}
