// The least and the greatest depth of the texels in a block's window (Dmitriev, Uralsky 2005; docs/algorithms/deferred.md 5.4).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/window.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1, rg32f) writeonly uniform image2DArray bounds;

vec2 extremes_of(ivec2 begin) {
    vec4 least = vec4(1.0), greatest = vec4(0.0);
    for (int y = 0; y < window; y += 2) {
        for (int x = 0; x < window; x += 2) {
            const vec4 quad = quad_at(begin + ivec2(x, y));
            least = min(least, quad);
            greatest = max(greatest, quad);
        }
    }
    return vec2(least_of(least), greatest_of(greatest));
}

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), begin = block * bounds_block - bounds_reach;
    if (any(greaterThanEqual(block * bounds_block, ivec2(int(push.size))))) return;
    vec2 found;
    if (leaves_map(begin)) found = clipped_extremes(begin);
    else found = extremes_of(begin);
    imageStore(bounds, ivec3(ivec2(push.offset) / bounds_block + block, push.layer), vec4(found, 0.0, 0.0));
}
