// The factor of each slice as its optical depth's code, in the words that atomics would have written: what follows is the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/functions/optical_depth.glsl"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/volume/voxels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 9) uniform sampler2DArray factors;
layout(set = 0, binding = 10, r32ui) uniform writeonly uimage2DArray voxels;

uint code_of(float factor) { return min(uint(optical_depth(factor) * push.codes_per_depth + 0.5), push.full_code); }

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(voxels)))) return;
    const int channel = at.y / int(push.height), row = at.y % int(push.height);
    const uint first = uint(at.z) * slices_per_word;
    uint word = 0u;
    for (uint i = 0u; i < slices_per_word && first + i < push.slices; ++i)
        word |= code_of(texelFetch(factors, ivec3(at.x, row, first + i), 0)[channel]) << shift_of(i);
    imageStore(voxels, at, uvec4(word));
}
