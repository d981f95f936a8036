// Composites the band's sorted lists over what is there, front to back: C += T (p + e), D += T d, T *= t
// (docs/algorithms/transparency.md 1 and 6.13).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/distortion/bent_background.glsl"
#include "passes/transparency/lists/pixel_lists.shared.h"
#include "passes/shaders/luminance.glsl"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/shaders/finished.glsl"
#include "passes/transparency/lists/fragments.glsl"
#include "passes/transparency/lists/per_iteration.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint distorts = 0u;  // 1: there are offsets and the background to read
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 6, scalar) readonly buffer Offsets { vec2 offsets[]; };
layout(set = 0, binding = 7) uniform sampler2DArray behind;
layout(set = 0, binding = 8, scalar) buffer Counters { ListCounters counters; };

vec3 sum = vec3(0.0), through = vec3(1.0);
vec2 offset = vec2(0.0);

void add_behind(uint node) {
    sum += through * (fragments[node].p + fragments[node].e);
    if (distorts != 0u) offset += luminance(through) * offsets[node];
    through *= fragments[node].t;
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const ivec3 texel = ivec3(at.x, at.y + band.first_row, at.z);
    const uint cell = cell_of(texel.xy, at.z);
    const uint start = starts[cell], count = list_count(cell);
    if (count == 0u) return;
    for (uint i = 0u; i < count; i += per_iteration)
        [[unroll]] for (uint k = 0u; k < per_iteration; ++k)
            if (i + k < count) add_behind(keys[start + i + k].fragment);
    if (!finished(band.width)) atomicAdd(counters.unfinished, 1u);
    const vec4 here = imageLoad(color, texel);
    const vec3 seen = distorts != 0u ? seen_behind(behind, texel, offset) : here.rgb;
    imageStore(color, texel, vec4(sum + through * seen, here.a));
}
