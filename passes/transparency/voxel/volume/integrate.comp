// Turns a column into its inclusive sums, in place: a sum is at most M and fits the field its extinction had
// (docs/algorithms/transparency.md 6.6). One thread per column and channel, a group for each tile: slices that nobody uses there
// are left out, and what is behind saturation is filled without being read.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/tiles.glsl"
#include "passes/transparency/voxel/volume/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10, r32ui) uniform uimage2DArray voxels;
layout(set = 0, binding = 14, r32ui) uniform writeonly uimage2DArray zero_slices;  // the first full one of each column
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };
#include "passes/transparency/voxel/volume/count_column.glsl"

uint zero_slice = no_overflow;

// Of the fields of a word, after what is in front of them.
uint summed_word(uint word, uint first_slice, uint overflow, inout uint sum) {
    uint sums = 0u;
    for (uint i = 0u; i < slices_per_word; ++i) {
        const uint left = push.full_code - sum;
        sum += first_slice + i >= overflow ? left : min(field(word, i * field_bits), left);
        if (sum == push.full_code) zero_slice = min(zero_slice, first_slice + i);
        sums |= sum << (i * field_bits);
    }
    return sums;
}

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, uvec2(push.width, push.height)))) return;
    const ivec2 column = column_of(texel, gl_GlobalInvocationID.z);
    const uint overflow = splat == splat_overflow_minimum ? nearest_overflow[index_of(column)] : no_overflow;
    uint sum = 0u, integrated = 0u;
    for (uint block = 0u; block < (push.words + 31u) / 32u; ++block)
        for (uint bits = used_words(gl_WorkGroupID.xy, block); bits != 0u; bits &= bits - 1u) {
            const uint word = 32u * block + uint(findLSB(bits));
            const ivec3 at = place_of(column, word * slices_per_word);
            const bool full = sum == push.full_code;
            const uint extinction = full ? 0u : imageLoad(voxels, at).r;
            imageStore(voxels, at, uvec4(summed_word(extinction, word * slices_per_word, overflow, sum)));
            if (!full) integrated += slices_per_word;
        }
    imageStore(zero_slices, ivec3(column, 0), uvec4(zero_slice));
    count_column(integrated, overflow != no_overflow, sum == push.full_code);
}
