// The least and the greatest depth of the texels in a block's window (Dmitriev, Uralsky 2005; docs/algorithms/deferred.md 5.4).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/bounds.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 67) const int bounds_block = 4;
layout(constant_id = 68) const int bounds_reach = 2;

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1, rg32f) writeonly uniform image2DArray bounds;
layout(push_constant, scalar) uniform Bounds { BoundsPush push; };

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), begin = block * bounds_block - bounds_reach;
    const ivec2 last_texel = ivec2(int(push.size) - 1), end = begin + bounds_block + 2 * bounds_reach - 1;
    if (any(greaterThan(block * bounds_block, last_texel))) return;
    const ivec2 first = max(begin, ivec2(0)), last = min(end, last_texel);
    const bool leaves = any(lessThan(begin, first)) || any(greaterThan(end, last));
    float least = push.is_face == 0u && leaves ? 0.0 : 1.0, greatest = 0.0;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const float depth = texelFetch(shadow_maps, ivec3(ivec2(push.offset) + ivec2(x, y), push.layer), 0).r;
            least = min(least, depth);
            greatest = max(greatest, depth);
        }
    }
    imageStore(bounds, ivec3(ivec2(push.offset) / bounds_block + block, push.layer), vec4(least, greatest, 0.0, 0.0));
}
