// A level of the hierarchy of bounds from 2 x 2 nodes of the one below it (Dmitriev, Uralsky 2005; docs/algorithms/deferred.md
// 5.3). Both lie in one image, in places of their own.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/bounds.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int level = 2;  // that is made: nodes of 2^level texels

layout(set = 0, binding = 1, rg32f) uniform image2DArray bounds;
layout(push_constant, scalar) uniform Bounds { BoundsPush push; };

ivec3 place(int of_level, ivec2 node) {
    const int width = 2 * imageSize(bounds).y;
    const ivec2 origin = ivec2(width - (width >> (of_level - 1)), 0);
    return ivec3(origin + (ivec2(push.offset) >> of_level) + node, push.layer);
}

void main() {
    const ivec2 node = ivec2(gl_GlobalInvocationID.xy), end = ivec2((int(push.size) - 1) >> (level - 1));
    if (any(greaterThan(2 * node, end))) return;
    const bool leaves = any(greaterThan(2 * node + 1, end));
    float least = push.is_face == 0u && leaves ? 0.0 : 1.0, greatest = 0.0;
    for (int child = 0; child < 4; ++child) {
        const ivec2 below = 2 * node + ivec2(child & 1, child >> 1);
        if (any(greaterThan(below, end))) continue;
        const vec2 found = imageLoad(bounds, place(level - 1, below)).xy;
        least = min(least, found.x);
        greatest = max(greatest, found.y);
    }
    imageStore(bounds, place(level, node), vec4(least, greatest, 0.0, 0.0));
}
