// The texels of a block's window, as bounds of shadow maps read them: by quads, or one by one where the window leaves the map.
#include "passes/shadows/bounds/bounds.shared.h"

layout(constant_id = 67) const int bounds_block = 4;
layout(constant_id = 68) const int bounds_reach = 2;

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(push_constant, scalar) uniform Bounds { BoundsPush push; };

const int window = bounds_block + 2 * bounds_reach;  // texels per edge: even

// Quads are gathered at the corner that their texels share, half a texel from where another quad would be chosen. The texels are
// (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1) from `texel` on.
vec4 quad_at(ivec2 texel) {
    const vec2 corner = vec2(ivec2(push.offset) + texel + 1) / vec2(textureSize(shadow_maps, 0).xy);
    return textureGather(shadow_maps, vec3(corner, float(push.layer))).wzxy;
}

float least_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float greatest_of(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

bool leaves_map(ivec2 begin) {
    return any(lessThan(begin, ivec2(0))) || any(greaterThan(begin + window, ivec2(int(push.size))));
}

// Least and greatest depth of a window that leaves the map: nothing is drawn beyond it; beyond a face its outermost texels go on.
vec2 clipped_extremes(ivec2 begin) {
    const ivec2 first = max(begin, ivec2(0)), last = min(begin + window, ivec2(int(push.size))) - 1;
    vec2 found = vec2(push.is_face == 0u ? 0.0 : 1.0, 0.0);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const float depth = texelFetch(shadow_maps, ivec3(ivec2(push.offset) + ivec2(x, y), push.layer), 0).r;
            found = vec2(min(found.x, depth), max(found.y, depth));
        }
    }
    return found;
}
