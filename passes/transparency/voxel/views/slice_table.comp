// Rows of the tables of slices: see views.cpp. A physical slice that holds nothing, or begins no run, is no row.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/views/views.shared.h"
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/slices/depth_curve.glsl"

layout(local_size_x = 1, local_size_y = 64) in;
layout(constant_id = 0) const uint shown = table_slices;
layout(set = 0, binding = 1, scalar) readonly buffer Counts { SliceCounts counts[]; };
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray numbers;

vec4 no_row() { return vec4(uintBitsToFloat(0x7fc00000u)); }

vec2 ends_of(uint slice) { return vec2(depth_of_slice(float(slice)), depth_of_slice(float(slice) + 1.0)); }

vec4 row_of_slice(uint slice) {
    if (sparse != 0u && counts[slice].tiles == 0u) return no_row();
    const uint place = virtual_slice(slice);
    return vec4(slice < push.interfaces ? vec2(0.0) : ends_of(place), place, counts[slice].tiles);
}

vec4 row_of_overflows(uint slice) {
    const float begin = slice < push.interfaces ? 0.0 : depth_of_slice(float(virtual_slice(slice)));
    return vec4(begin, slice, counts[slice].overflowed, counts[slice].saturated);
}

// Of a virtual slice.
vec4 row_of_histogram(uint slice) {
    const bool is_there = adaptive == 0u || (warp_entries[slice] & warp_used) != 0u;
    const int physical = is_there ? physical_slice(int(slice)) : -1;
    return vec4(ends_of(slice), physical, is_there ? counts[physical].columns : 0u);
}

vec4 row_of_divider(uint used) {
    return vec4(is_halved() ? warp.halvings : 0u, is_halved() ? warp.fitting : 0u, virtual_slices(), used);
}

// Slices that follow each other among the virtual ones, too.
vec4 row_of_run(uint first, uint used) {
    const uint begin = virtual_slice(first);
    const bool is_interface = first < push.interfaces;
    if (is_interface || first > push.interfaces && virtual_slice(first - 1u) + 1u == begin) return no_row();
    uint last = first;
    while (last + 1u < used && virtual_slice(last + 1u) == virtual_slice(last) + 1u) ++last;
    return vec4(depth_of_slice(float(begin)), depth_of_slice(float(virtual_slice(last)) + 1.0), first, last - first + 1u);
}

void main() {
    const uint slice = gl_GlobalInvocationID.y, used = adaptive != 0u ? push.interfaces + warp.used : physical_slices();
    if (slice >= uint(imageSize(numbers).y)) return;
    vec4 row = no_row();
    if (shown == table_divider) row = row_of_divider(used);
    else if (shown == table_histogram && slice < virtual_slices()) row = row_of_histogram(slice);
    else if (shown == table_runs && slice < used) row = row_of_run(slice, used);
    else if (shown == table_overflows && slice < used) row = row_of_overflows(slice);
    else if (shown == table_slices && slice < used) row = row_of_slice(slice);
    imageStore(numbers, ivec3(0, slice, 0), row);
}
