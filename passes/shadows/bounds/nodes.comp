// A level of nodes over bounds of shadow maps: a node of level l holds the extremes of 2^l x 2^l texels of the bounds, so it answers
// for every lookup that those serve (Chen, Baran, Durand, Jarosz 2011; docs/algorithms/deferred.md 6.3).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/bounds.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 67) const int bounds_block = 4;
layout(constant_id = 0) const int level = 1;  // that is made, from the level below it

layout(set = 0, binding = 0) uniform sampler2DArray shadow_bounds;  // level 0
layout(set = 0, binding = 1, rg32f) uniform image2DArray nodes;     // levels 1, 2, .. side by side
layout(push_constant, scalar) uniform Bounds { BoundsPush push; };

ivec3 place(int of_level, ivec2 node) {
    const int width = 2 * imageSize(nodes).y;
    const ivec2 origin = ivec2(width - (width >> (of_level - 1)), 0);
    return ivec3(origin + (ivec2(push.offset) / bounds_block >> of_level) + node, push.layer);
}

vec2 extremes_below(ivec2 node) {
    if (level > 1) return imageLoad(nodes, place(level - 1, node)).xy;
    return texelFetch(shadow_bounds, ivec3(ivec2(push.offset) / bounds_block + node, push.layer), 0).xy;
}

void main() {
    const ivec2 node = ivec2(gl_GlobalInvocationID.xy), end = ivec2((int(push.size) - 1) / bounds_block >> (level - 1));
    if (any(greaterThan(2 * node, end))) return;
    vec2 found = vec2(1.0, 0.0);
    for (int child = 0; child < 4; ++child) {
        const ivec2 below = 2 * node + ivec2(child & 1, child >> 1);
        if (any(greaterThan(below, end))) continue;
        const vec2 extremes = extremes_below(below);
        found = vec2(min(found.x, extremes.x), max(found.y, extremes.y));
    }
    imageStore(nodes, place(level, node), vec4(found, 0.0, 0.0));
}
