// Empties the voxels that will be used, and no others (transparency chapter 6.8). A group for each tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/tiles.glsl"
#include "passes/transparency/voxel/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10, r32ui) uniform writeonly uimage2DArray voxels;
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, uvec2(push.width, push.height)))) return;
    const ivec2 column = column_of(texel, gl_GlobalInvocationID.z);
    uint cleared = 0u;
    for (uint word = 0u; word < push.words; ++word) {
        if (!is_used(gl_WorkGroupID.xy, word)) continue;
        imageStore(voxels, ivec3(column, word), uvec4(0u));
        cleared += slices_per_word;
    }
    if (splat == splat_overflow_minimum) nearest_overflow[index_of(column)] = no_overflow;
    atomicAdd(counters.allocated, push.words * slices_per_word);
    if (cleared > 0u) atomicAdd(counters.cleared, cleared);
}
