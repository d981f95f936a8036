// Composites the band's sorted lists over what is there, front to back: C += T (p + e), T *= t (transparency chapter 1).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/list_events.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;

vec3 composite(uint start, uint count, vec3 behind) {
    vec3 sum = vec3(0.0), through = vec3(1.0);
    for (uint i = 0u; i < count; ++i) {
        const ListEvent event = events[keys[start + i].event];
        sum += through * (event.p + event.e);
        through *= event.t;
    }
    return sum + through * behind;
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const ivec3 texel = ivec3(at.x, at.y + band.first_row, at.z);
    const uint cell = cell_of(texel.xy, at.z);
    const uint start = list_start(cell), count = stored(start, counts[cell]);
    const vec4 behind = imageLoad(color, texel);
    if (count > 0u) imageStore(color, texel, vec4(composite(start, count, behind.rgb), behind.a));
}
