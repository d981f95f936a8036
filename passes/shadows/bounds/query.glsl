// Asks bounds of shadow maps whether every texel of a lookup agrees (docs/algorithms/deferred.md 5.5). passes/shadows/bounds/build.h
// builds the image, fixes the constants and says what the reach must be.
//
// Depth is 1 at the light: a texel is lit where the receiver's depth is at least the map's. `corner` is the map's upper left texel
// in shadow_maps and its layer, `size` its edge in texels, `u` the place in the map in texels, centers at +.5. All of it works for
// u outside the map, too.
#ifndef PASSES_SHADOWS_BOUNDS_QUERY_GLSL
#define PASSES_SHADOWS_BOUNDS_QUERY_GLSL

layout(constant_id = 67) const int bounds_block = 4;  // texels per edge
layout(constant_id = 68) const int bounds_reach = 2;  // texels beyond each edge of a block

layout(set = 0, binding = 27) uniform sampler2DArray shadow_bounds;

const uint class_lit = 0u;        // every texel is lit: the lookup gives exactly 1
const uint class_shadowed = 1u;   // no texel is lit: exactly 0
const uint class_expensive = 2u;  // texels have to be compared
const uint class_outside = 3u;    // no texel of the map is near: lit

const vec2 unbounded = vec2(-1.0, 2.0e38);  // of maps smaller than a block

// NaN is neither lit nor shadowed: its texels are compared as ever. A receiver behind everything has depth 0, as in a lookup.
uint bounds_class(vec2 least_greatest, float depth) {
    if (depth >= least_greatest.y) return class_lit;
    return depth < least_greatest.x ? class_shadowed : class_expensive;
}

bool has_bounds(int size) { return size >= bounds_block; }

// The block that serves u; outside the map the nearest one, whose window holds what a lookup there reads.
ivec2 block_of(int size, vec2 u) { return clamp(ivec2(floor(u)), ivec2(0), ivec2(size - 1)) / bounds_block; }

vec4 bounds_texel(ivec3 corner, ivec2 block) {
    return texelFetch(shadow_bounds, ivec3(corner.xy / bounds_block + block, corner.z), 0);
}

// Form extremes: the least and the greatest depth within the reach of u. One fetch.
vec2 extremes_at(ivec3 corner, int size, vec2 u) {
    return has_bounds(size) ? bounds_texel(corner, block_of(size, u)).xy : unbounded;
}

// Form levels: of a node of 2^level x 2^level texels, the node (x, y) beginning at texel 2^level (x, y). Levels lie side by side.
ivec2 level_origin(int level, int height) { return ivec2(2 * height - (2 * height >> (level - 1)), 0); }

vec2 extremes_of_node(ivec3 corner, int level, ivec2 node) {
    const ivec2 origin = level_origin(level, textureSize(shadow_bounds, 0).y);
    return texelFetch(shadow_bounds, ivec3(origin + (corner.xy >> level) + node, corner.z), 0).xy;
}

// Forms slabs and planes: the least and the greatest depth that the texels first..last of a lookup at u can have. One fetch. Texels beyond the
// window are outside the map and read as those at its rim.
vec2 slab_at(ivec3 corner, int size, vec2 u, ivec2 first, ivec2 last) {
    if (!has_bounds(size)) return unbounded;
    const ivec2 block = block_of(size, u);
    const vec4 slab = bounds_texel(corner, block);
    const float rim = 0.5 * float(bounds_block - 1) + float(bounds_reach);  // of the window, from its center
    const vec2 center = vec2(block * bounds_block) + 0.5 * float(bounds_block - 1);
    const vec2 a = slab.zw * clamp(vec2(first) - center, -rim, rim), b = slab.zw * clamp(vec2(last) - center, -rim, rim);
    const vec2 least = min(a, b), greatest = max(a, b);
    return vec2(slab.x + least.x + least.y, slab.y + greatest.x + greatest.y);
}

#endif
