// Bounds of overlapping windows from those of blocks that have none: a window of K texels is K / part of them per edge
// (docs/algorithms/deferred.md 5.4), which is what K x K texels give at a fraction of the reads.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/bounds/bounds.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 67) const int bounds_block = 4;
layout(constant_id = 68) const int bounds_reach = 2;
layout(constant_id = 0) const int part = 2;  // texels per edge of a block that is read; divides the two above

layout(set = 0, binding = 0) uniform sampler2DArray parts;
layout(set = 0, binding = 1, rg32f) writeonly uniform image2DArray bounds;
layout(push_constant, scalar) uniform Bounds { BoundsPush push; };

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), begin = (block * bounds_block - bounds_reach) / part;
    const ivec2 last_part = ivec2((int(push.size) - 1) / part), end = begin + (bounds_block + 2 * bounds_reach) / part - 1;
    if (any(greaterThanEqual(block * bounds_block, ivec2(push.size)))) return;
    const ivec2 first = max(begin, ivec2(0)), last = min(end, last_part);
    const bool leaves = any(lessThan(begin, first)) || any(greaterThan(end, last));
    float least = push.is_face == 0u && leaves ? 0.0 : 1.0, greatest = 0.0;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const vec2 found = texelFetch(parts, ivec3(ivec2(push.offset) / part + ivec2(x, y), push.layer), 0).xy;
            least = min(least, found.x);
            greatest = max(greatest, found.y);
        }
    }
    imageStore(bounds, ivec3(ivec2(push.offset) / bounds_block + block, push.layer), vec4(least, greatest, 0.0, 0.0));
}
