// Empties the voxels that will be used, and no others (docs/algorithms/transparency.md 6.8). A group for each tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/tiles.glsl"
#include "passes/transparency/voxel/volume/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10, r32ui) uniform writeonly uimage2DArray voxels;
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

// How many voxels of a word's slices.
uint cleared_of(ivec2 column, uint word) {
    uint cleared = 0u;
    if (is_used(gl_WorkGroupID.xy, word, source_gray)) {
        imageStore(voxels, place_of(column, word * slices_per_word), uvec4(0u));
        cleared += slices_per_word;
    }
    if (packs_colors != 0u && is_used(gl_WorkGroupID.xy, word, source_color)) {
        const uint first = word * slices_per_word, end = min(first + slices_per_word, push.slices);
        for (uint slice = first; slice < end; ++slice) imageStore(voxels, ivec3(column, slice), uvec4(0u));
        cleared += end - first;
    }
    return cleared;
}

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, uvec2(push.width, push.height)))) return;
    const ivec2 column = column_of(texel, gl_GlobalInvocationID.z);
    uint cleared = 0u;
    for (uint block = 0u; block < (push.words + 31u) / 32u; ++block)
        for (uint bits = used_words(gl_WorkGroupID.xy, block); bits != 0u; bits &= bits - 1u)
            cleared += cleared_of(column, 32u * block + uint(findLSB(bits)));
    const uint planes = packs_colors != 0u ? 1u + push.channels : 1u;
    if (splat == splat_overflow_minimum)
        for (uint plane = 0u; plane < planes; ++plane)
            nearest_overflow[index_of(ivec2(column.x, column.y + plane * push.height))] = no_overflow;
    const uint columns = subgroupAdd(1u), cleared_together = subgroupAdd(cleared);
    if (!subgroupElect()) return;
    if (sparse == 0u) atomicAdd(counters.voxels, columns * (push.words * slices_per_word + (packs_colors != 0u ? push.slices : 0u)));
    if (cleared_together > 0u) atomicAdd(counters.cleared, cleared_together);
}
