// Light blockers and portals per point, exact and without division (docs/algorithms/lighting.md 2.2; Kircher, Rendering
// Technology in Agents of Mayhem, GDC 2018). The only such test: opaque, transparent and per-tile code call it, so their edges
// are the same bits. All of it is precise, in products and sums written out: contracted differently in two shaders, it would
// leave seams between tiles.
#ifndef PASSES_SHADERS_BLOCKERS_GLSL
#define PASSES_SHADERS_BLOCKERS_GLSL
#include "passes/shaders/blockers.shared.h"
#include "passes/shaders/light_types.glsl"
#include "passes/shaders/scene.glsl"

uint low_bits(uint n) { return n >= 32u ? 0xffffffffu : (1u << n) - 1u; }

vec3 off_surface(vec3 position, vec3 normal) {
    precise vec3 result = position + normal * max(least_surface_offset, surface_offset_per_meter * position.z);
    return result;
}

// Homogeneous: a place, or with w = 0 the direction towards the light.
vec4 light_point(LightRecord light) {
    return light_has_range(light.type) ? vec4(light.position, 1.0) : vec4(-light.direction, 0.0);
}

float precise_dot(vec3 a, vec3 b) {
    precise float result = a.x * b.x + a.y * b.y + a.z * b.z;
    return result;
}

vec3 precise_cross(vec3 a, vec3 b) {
    precise vec3 result = vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return result;
}

// The light seen from the blocker's center, which is subtracted before any product: no cancellation after it.
vec3 from_center(BlockerRecord blocker, vec4 light) {
    precise vec3 result = light.xyz - blocker.center * light.w;
    return result;
}

// How far the light is from the blocker's plane on the normal's side; 0 where the blocker does not stop it anywhere.
float stopped_height(BlockerRecord blocker, vec4 light) {
    const float height = precise_dot(blocker.normal, from_center(blocker, light));
    const bool stops = abs(height) > (light.w > 0.0 ? light_before_blocker : direction_before_blocker) &&
                       (blocker.one_sided == 0u || height > 0.0);
    return stops ? height : 0.0;
}

// Where the way from light to position crosses the blocker's plane: (a, b) / w in its (u, v); w = 0 where it does not.
vec3 plane_crossing(BlockerRecord blocker, vec4 light, vec3 position) {
    precise const vec3 l = from_center(blocker, light);
    precise const vec3 p = position - blocker.center;
    const float height = stopped_height(blocker, light);
    precise const float before = abs(height);
    precise const float at = height < 0.0 ? -precise_dot(blocker.normal, p) : precise_dot(blocker.normal, p);
    if (before == 0.0 || at >= -point_behind_blocker) return vec3(0.0);
    const vec3 v = precise_cross(blocker.normal, blocker.u);
    precise const float a = before * precise_dot(blocker.u, p) - at * precise_dot(blocker.u, l);
    precise const float b = before * precise_dot(v, p) - at * precise_dot(v, l);
    precise const float w = before - at * light.w;
    return vec3(a, b, w);
}

// A closed set: no crack between blockers that share an edge.
bool inside_blocker(BlockerRecord blocker, vec3 at) {
    precise const vec2 reach = vec2(blocker.half_u, blocker.half_v) * at.z;
    return at.z > 0.0 && abs(at.x) <= reach.x && abs(at.y) <= reach.y;
}

// An open set: a portal without area opens nothing.
bool inside_portal(BlockerPortalRecord portal, vec3 at) {
    precise const vec2 d = at.xy - portal.center * at.z;
    precise const vec2 turned = vec2(portal.turn.x * d.x + portal.turn.y * d.y, portal.turn.x * d.y - portal.turn.y * d.x);
    precise const vec2 reach = portal.half_extent * at.z;
    return abs(turned.x) < reach.x && abs(turned.y) < reach.y;
}

bool any_portal_open(LightRecord light, vec3 at, uint portal_mask) {
    for (; portal_mask != 0u; portal_mask &= portal_mask - 1u)
        if (inside_portal(blocker_portals[light.first_portal + uint(findLSB(portal_mask))], at)) return true;
    return false;
}

// Whether the light reaches a position off the surface. Bits of the masks are the light's own: blockers and portals that need no
// test here are left out of them (docs/algorithms/lighting.md 2.7).
bool blockers_pass(LightRecord light, vec3 position, uint blocker_mask, uint portal_mask) {
    const vec4 from = light_point(light);
    for (; blocker_mask != 0u; blocker_mask &= blocker_mask - 1u) {
        const LightBlockerRecord use = light_blockers[light.first_blocker + uint(findLSB(blocker_mask))];
        const BlockerRecord blocker = blockers[use.blocker];
        const vec3 at = plane_crossing(blocker, from, position);
        if (inside_blocker(blocker, at) && !any_portal_open(light, at, use.portals & portal_mask)) return false;
    }
    return true;
}

#endif
