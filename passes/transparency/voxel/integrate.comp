// Turns a column into its inclusive sums, in place: a sum is at most M and fits the field its extinction had (transparency chapter
// 6.6). One thread per column and channel, which adds up until nothing is seen any more.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10, r32ui) uniform uimage2DArray voxels;
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

// Of the fields of a word, after what is in front of them.
uint summed_word(uint word, uint first_slice, uint overflow, inout uint sum) {
    uint sums = 0u;
    for (uint i = 0u; i < slices_per_word; ++i) {
        const uint left = push.full_code - sum;
        sum += first_slice + i >= overflow ? left : min(field(word, i * field_bits), left);
        sums |= sum << (i * field_bits);
    }
    return sums;
}

void main() {
    const ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, imageSize(voxels).xy))) return;
    const uint overflow = splat == splat_overflow_minimum ? nearest_overflow[index_of(column)] : no_overflow;
    const uint words = uint(imageSize(voxels).z);
    uint sum = 0u, word = 0u;
    for (; word < words && sum < push.full_code; ++word) {
        const ivec3 at = ivec3(column, word);
        const uint extinction = imageLoad(voxels, at).r;
        imageStore(voxels, at, uvec4(summed_word(extinction, word * slices_per_word, overflow, sum)));
    }
    const bool full = sum == push.full_code;
    for (; word < words; ++word) {
        uint ahead = sum;
        imageStore(voxels, ivec3(column, word), uvec4(summed_word(0u, 0u, no_overflow, ahead)));
    }
    atomicAdd(counters.columns, 1u);
    if (overflow != no_overflow) atomicAdd(counters.overflowed, 1u);
    if (full) atomicAdd(counters.saturated, 1u);
}
