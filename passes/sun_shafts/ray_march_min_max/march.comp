// A step asks the bounds of the map's block first, and the map only where they do not decide: as X-Ray's shafts do
// (docs/algorithms/deferred.md 5.5, 6.3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shadows/bounds/query.glsl"
#include "passes/shadows/bounds/nodes.glsl"
#include "passes/sun_shafts/march.glsl"

// Outside the map a lookup is lit without reading it.
bool is_decided(MapRay map, vec3 at, inout Tally tally, out float lit) {
    lit = 1.0;
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThanEqual(at.xy, vec2(map.size)))) return false;
    ++tally.bounds;
    const uint found = bounds_class(extremes_at(map.corner, map.size, at.xy), max(at.z, 0.0));
    if (found == class_expensive) return false;
    if (found == class_shadowed) lit = 0.0;
    ++tally.skipped;
    return true;
}

// Places between two ends lie in the rectangle of blocks between theirs and in the range of depth between theirs: sums and products
// round in order. Outside the map steps are asked one by one.
bool are_decided(MapRay map, vec3 first, vec3 last, inout Tally tally, out float lit) {
    lit = 1.0;
    const vec3 low = min(first, last), high = max(first, last);
    if (!has_bounds(map.size) || any(lessThan(low.xy, vec2(0.0))) || any(greaterThanEqual(high.xy, vec2(map.size)))) return false;
    const ivec2 a = block_of(map.size, low.xy), b = block_of(map.size, high.xy);
    const int level = level_around(a, b);
    if (level > bounds_levels) return false;
    vec2 extremes = vec2(1.0, 0.0);
    for (int y = a.y >> level; y <= b.y >> level; ++y) {
        for (int x = a.x >> level; x <= b.x >> level; ++x) {
            const vec2 found = extremes_of_blocks(map.corner, level, ivec2(x, y));
            extremes = vec2(min(extremes.x, found.x), max(extremes.y, found.y));
            ++tally.bounds;
        }
    }
    if (bounds_class(extremes, max(low.z, 0.0)) == class_lit) return true;
    lit = 0.0;
    return bounds_class(extremes, max(high.z, 0.0)) == class_shadowed;
}
