// What is in each slice, counted over all columns: tiles that use it, columns in which it is the first to overflow or to be full.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/tiles.glsl"
#include "passes/transparency/voxel/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform usampler2DArray voxels;
layout(set = 0, binding = 1, scalar) buffer Counts { SliceCounts counts[]; };

void count_tile(uvec2 tile) {
    for (uint slice = 0u; slice < push.slices; ++slice)
        if (is_used(tile, slice / slices_per_word)) atomicAdd(counts[slice].tiles, 1u);
}

void count_full(ivec2 column, uvec2 tile) {
    for (uint slice = 0u; slice < push.slices; ++slice) {
        if (!is_used(tile, slice / slices_per_word)) continue;
        if (field(texelFetch(voxels, place_of(column, slice), 0).r, shift_of(slice)) != push.full_code) continue;
        atomicAdd(counts[slice].saturated, 1u);
        return;
    }
}

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy, tile = gl_WorkGroupID.xy;
    if (any(greaterThanEqual(texel, uvec2(push.width, push.height)))) return;
    const ivec2 column = column_of(texel, gl_GlobalInvocationID.z);
    if (gl_LocalInvocationIndex == 0u && gl_GlobalInvocationID.z == 0u) count_tile(tile);
    const uint overflow = splat == splat_overflow_minimum ? nearest_overflow[index_of(column)] : no_overflow;
    if (overflow != no_overflow) atomicAdd(counts[overflow].overflowed, 1u);
    count_full(column, tile);
}
