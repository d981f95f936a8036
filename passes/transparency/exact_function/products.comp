// Replaces the transmittance of every fragment of the band by that of all fragments up to it, in the order of its list: T(z) of any depth
// is then found by binary search.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/functions/function.shared.h"
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/shaders/finished.glsl"
#include "passes/transparency/lists/places.glsl"
#include "passes/transparency/lists/per_iteration.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 4, scalar) readonly buffer Keys { ListKey keys[]; };
layout(set = 0, binding = 5, scalar) buffer Fragments { ListFragment fragments[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { FunctionCounters counters; };

vec3 through = vec3(1.0);

void multiply(uint node) {
    through *= fragments[node].t;
    fragments[node].t = through;
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const uint cell = cell_of(uvec2(at.x, at.y + band.first_row), at.z);
    const uint start = starts[cell], count = list_count(cell);
    for (uint i = 0u; i < count; i += per_iteration)
        [[unroll]] for (uint k = 0u; k < per_iteration; ++k)
            if (i + k < count) multiply(keys[start + i + k].fragment);
    if (!finished(band.width)) atomicAdd(counters.lists.unfinished, 1u);
}
