// Rows of the tables of slices: see views.cpp. A slice that holds nothing, or begins no run, is no row.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/depth_curve.glsl"

layout(local_size_x = 1, local_size_y = 64) in;
layout(constant_id = 0) const uint shows_runs = 0u;
layout(set = 0, binding = 1, scalar) readonly buffer Counts { SliceCounts counts[]; };
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray numbers;

vec4 row_of_slice(uint slice) {
    if (sparse != 0u && counts[slice].tiles == 0u) return vec4(uintBitsToFloat(0x7fc00000u));
    const float begin = slice < push.interfaces ? 0.0 : depth_of_slice(float(virtual_slice(slice)));
    return vec4(begin, counts[slice].tiles, counts[slice].overflowed, counts[slice].saturated);
}

// Slices that follow each other among the virtual ones, too.
vec4 row_of_run(uint first, uint used) {
    const uint begin = virtual_slice(first);
    const bool is_interface = first < push.interfaces;
    if (is_interface || first > push.interfaces && virtual_slice(first - 1u) + 1u == begin) return vec4(uintBitsToFloat(0x7fc00000u));
    uint last = first;
    while (last + 1u < used && virtual_slice(last + 1u) == virtual_slice(last) + 1u) ++last;
    return vec4(depth_of_slice(float(begin)), depth_of_slice(float(virtual_slice(last)) + 1.0), first, last - first + 1u);
}

void main() {
    const uint slice = gl_GlobalInvocationID.y, used = adaptive != 0u ? push.interfaces + warp.used : physical_slices();
    if (slice >= uint(imageSize(numbers).y)) return;
    vec4 row = vec4(uintBitsToFloat(0x7fc00000u));
    if (slice < used) row = shows_runs != 0u ? row_of_run(slice, used) : row_of_slice(slice);
    imageStore(numbers, ivec3(0, slice, 0), row);
}
