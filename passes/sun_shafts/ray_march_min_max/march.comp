// A step asks the bounds of the map's block first, and the map only where they do not decide: as X-Ray's shafts do
// (docs/algorithms/deferred.md 5.5, 6.3; reversed depth).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sun_shafts/march.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray bounds;

// Texels that a lookup touches must all be the map's: beyond it is nothing, whatever its neighbors in the layer hold.
bool is_within(MapRay map, vec2 place) {
    const ivec2 first = ivec2(floor(taps == taps_1 ? place : place - 0.5)), last = taps == taps_1 ? first : first + 1;
    return !any(lessThan(first, ivec2(0))) && !any(greaterThanEqual(last, ivec2(map.size)));
}

bool is_decided(MapRay map, vec3 at, inout Tally tally, out float lit) {
    lit = 1.0;
    if (!is_within(map, at.xy)) return false;
    const ivec2 block = (map.corner.xy + ivec2(floor(at.xy))) / int(bounds_block);
    const vec2 range = texelFetch(bounds, ivec3(block, map.corner.z), 0).rg;
    const float depth = max(at.z, 0.0);
    ++tally.bounds;
    if (depth < range.x) lit = 0.0;
    else if (!(depth >= range.y)) return false;
    ++tally.skipped;
    return true;
}
