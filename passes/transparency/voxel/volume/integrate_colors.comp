// Turns words of three channels into inclusive sums, in place, of what has a color and of what is gray
// (docs/algorithms/transparency.md 6.6). One thread per column, a group for each tile; see integrate.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/tiles.glsl"
#include "passes/transparency/voxel/volume/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10, r32ui) uniform uimage2DArray voxels;
layout(set = 0, binding = 14, r32ui) uniform writeonly uimage2DArray zero_slices;  // the first full one of each column and channel
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };
#include "passes/transparency/voxel/volume/count_column.glsl"

struct Sums {
    uint gray;    // in codes of push.full_code
    uvec3 color;  // what has one
};

bool is_full(uvec3 sum) { return all(equal(sum, uvec3(color_full_code))); }

// Codes of many bits become few once they are summed up: thin layers are not lost.
uvec3 total(Sums sums) {
    const uint gray = (sums.gray * push.color_scale + color_scale_one / 2u) / color_scale_one;
    return min(sums.color + gray, color_full_code);
}

void add(inout Sums sums, uint gray, uvec3 color) {
    sums.gray += min(gray, push.full_code - sums.gray);
    sums.color += min(color, color_full_code - sums.color);
}

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, uvec2(push.width, push.height)))) return;
    const uvec3 overflow = uvec3(overflow_of(texel, 0u), overflow_of(texel, 1u), overflow_of(texel, 2u));
    Sums sums = Sums(0u, uvec3(0u));
    uvec3 zero_slice = uvec3(no_overflow);
    uint integrated = 0u;
    for (uint block = 0u; block < (push.words + 31u) / 32u; ++block)
        for (uint bits = used_words(gl_WorkGroupID.xy, block); bits != 0u; bits &= bits - 1u) {
            const uint word = 32u * block + uint(findLSB(bits));
            const bool gray = is_used(gl_WorkGroupID.xy, word, source_gray), colors = is_used(gl_WorkGroupID.xy, word, source_color);
            const uint first = word * slices_per_word, end = min(first + slices_per_word, push.slices);
            const bool full = is_full(total(sums));
            const uint extinction = gray && !full ? imageLoad(voxels, place_of(ivec2(texel), first)).r : 0u;
            if (!full) integrated += (gray ? slices_per_word : 0u) + (colors ? end - first : 0u);
            for (uint slice = first; slice < end; ++slice) {
                const ivec3 at = ivec3(texel, slice);
                const uvec3 codes = color_fields(colors && !full ? imageLoad(voxels, at).r : 0u);
                add(sums, field(extinction, shift_of(slice)), mix(codes, uvec3(color_full_code), greaterThanEqual(uvec3(slice), overflow)));
                const uvec3 sum = total(sums);
                zero_slice = min(zero_slice, mix(uvec3(no_overflow), uvec3(slice), equal(sum, uvec3(color_full_code))));
                imageStore(voxels, at, uvec4(color_word(sum)));
            }
        }
    for (uint channel = 0u; channel < 3u; ++channel)
        imageStore(zero_slices, ivec3(column_of(texel, channel), 0), uvec4(zero_slice[channel]));
    count_column(integrated, any(notEqual(overflow, uvec3(no_overflow))), is_full(total(sums)));
}
