// Irradiance over pi that a grid gives at a surface: some way before it, from the eight cells around, without those that a blocker hides
// from it (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_GATHERED_LIGHT_GLSL
#define PASSES_INDIRECT_LPV_GATHERED_LIGHT_GLSL
#include "passes/indirect/lpv/apply/taps.glsl"

layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

// How much of the light is kept, by how it changes on its way through the surface: what grows towards the inside comes from behind.
float kept(vec4 light, vec4 behind) {
    const vec4 change = light - behind;
    const float size = length(light) * length(change);
    const float cosine = size > 0.0 ? dot(light, change) / size : 1.0;
    return pow(clamp(0.5 + 0.5 * cosine, 0.0, 1.0), damping);
}

vec3 kept_of(LightCell light, GridPlace grid, LitPlace lit) {
    const SeenLight behind = seen_light_before(grid, lit, -0.5);
    if (behind.tests > 0u) atomicAdd(counters.blocker_tests, behind.tests);
    return vec3(kept(light.red, behind.light.red), kept(light.green, behind.light.green), kept(light.blue, behind.light.blue));
}

vec3 gathered_light(GridPlace grid, LitPlace lit) {
    const SeenLight seen = seen_light(grid, lit);
    if (seen.hidden > 0u) atomicAdd(counters.hidden_taps, seen.hidden);
    if (seen.near > 0u) atomicAdd(counters.samples_near_blockers, 1u);
    if (seen.near > 0u) atomicAdd(counters.blocker_tests, seen.tests);
    const vec3 received = received_light(grid, seen, first_facing(), lit.normal);
    if (damping == 0.0) return received;
    return received * kept_of(seen.light, grid, lit);
}

#endif
