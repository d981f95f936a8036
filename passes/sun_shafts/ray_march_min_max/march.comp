// A step asks the bounds of the map's block first, and the map only where they do not decide: as X-Ray's shafts do
// (docs/algorithms/deferred.md 5.5, 6.3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shadows/bounds/query.glsl"
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
