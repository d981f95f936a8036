// The pixel and the sample that a thread shades, by whichever routing (passes/edges/routing/shade_samples.h declares the steps). For
// shaders of 8 x 8 threads a group.
#ifndef PASSES_EDGES_ROUTED_GLSL
#define PASSES_EDGES_ROUTED_GLSL
#include "passes/edges/plain_pixels.glsl"
#include "passes/edges/routing/routing.shared.h"

layout(constant_id = 29) const uint threads_of = threads_of_samples;

// Pixels, x + 65536 y, row by row; in the row below the picture, how many there are.
layout(set = 0, binding = 26) uniform usampler2D edge_list;

ivec3 listed_place(ivec3 extent) {
    const uint group = gl_WorkGroupID.y * groups_per_row + gl_WorkGroupID.x;
    const uint thread = group * threads_per_group + gl_LocalInvocationIndex, further = uint(extent.z) - 1u;
    const uint entry = thread / further;
    if (entry >= texelFetch(edge_list, ivec2(0, extent.y), 0).r) return extent;
    const uint pixel = texelFetch(edge_list, ivec2(entry % uint(extent.x), entry / uint(extent.x)), 0).r;
    return ivec3(pixel & 0xffffu, pixel >> 16, 1u + thread % further);
}

// Outside of the picture, whose extent and samples are given, where the thread has nothing to shade.
ivec3 place_of_thread(ivec3 extent) {
    if (threads_of == threads_of_list) return listed_place(extent);
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    return at.z > 0 && is_plain(at.xy) ? extent : at;
}

#endif
