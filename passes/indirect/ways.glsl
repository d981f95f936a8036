// Ways between two points and the blockers across them: one rule for what is injected, for links between cells and for what a surface
// takes of a cell (docs/algorithms/lighting.md 5.8). Without the thresholds that light's own ways have: a cell's middle near a
// blocker belongs to one side. All blockers of the frame stop light from both sides.
#ifndef PASSES_INDIRECT_WAYS_GLSL
#define PASSES_INDIRECT_WAYS_GLSL
#include "passes/indirect/ways.shared.h"
#include "passes/shaders/blockers.glsl"

layout(constant_id = 70) const uint blocker_count = 0u;
layout(constant_id = 71) const uint portal_count = 0u;

bool is_before(BlockerRecord blocker, float height) {
    return height >= (dot(view.to_world * blocker.normal, side_of_plane) > 0.0 ? -on_plane : on_plane);
}

// Where the way crosses the plane: (a, b) / w in its (u, v); w = 0 where it does not. The way begins at a place, or with w = 0 it comes from
// a direction.
vec3 way_crossing(BlockerRecord blocker, vec4 from, vec3 to) {
    precise const vec3 p = from_center(blocker, from), q = to - blocker.center;
    const float a = precise_dot(blocker.normal, p), b = precise_dot(blocker.normal, q);
    if (is_before(blocker, a) == is_before(blocker, b)) return vec3(0.0);
    const vec3 v = precise_cross(blocker.normal, blocker.u);
    precise const float s = abs(b), t = abs(a);
    precise const vec3 at = vec3(s * precise_dot(blocker.u, p) + t * precise_dot(blocker.u, q),
                                 s * precise_dot(v, p) + t * precise_dot(v, q), s * from.w + t);
    return at;
}

vec3 way_crossing(BlockerRecord blocker, vec3 from, vec3 to) { return way_crossing(blocker, vec4(from, 1.0), to); }

// The first of the blocker's portals, which lie together: found by halving.
uint first_portal(uint blocker) {
    uint first = 0u;
    for (uint count = portal_count; count > 0u;) {
        const uint half_count = count / 2u;
        const bool is_before = portals[first + half_count].blocker < blocker;
        if (is_before) first += half_count + 1u;
        count = is_before ? count - half_count - 1u : half_count;
    }
    return first;
}

bool passes_portal(uint blocker, vec3 at) {
    for (uint i = first_portal(blocker); i < portal_count && portals[i].blocker == blocker; ++i)
        if (inside_portal(portals[i], at)) return true;
    return false;
}

bool stops(uint blocker, vec3 from, vec3 to) {
    const vec3 at = way_crossing(blockers[blocker], from, to);
    return inside_blocker(blockers[blocker], at) && !passes_portal(blocker, at);
}

// Whether a blocker that a light lists lies between the light and the place where ways from a surface begin.
bool is_behind_blocker(LightRecord light, vec3 begin) {
    const vec4 from = light_point(light);
    for (uint left = low_bits(light.blockers); left != 0u; left &= left - 1u) {
        const LightBlockerRecord use = light_blockers[light.first_blocker + uint(findLSB(left))];
        const BlockerRecord blocker = blockers[use.blocker];
        if (stopped_height(blocker, from) == 0.0) continue;
        const vec3 at = way_crossing(blocker, from, begin);
        if (inside_blocker(blocker, at) && !any_portal_open(light, at, use.portals & low_bits(light.portals))) return true;
    }
    return false;
}

bool is_stopped(vec3 from, vec3 to) {
    for (uint i = 0u; i < blocker_count; ++i)
        if (stops(i, from, to)) return true;
    return false;
}

#endif
