// Irradiance over pi that a grid gives at a surface: half a cell before it, from the eight cells around, without those that a blocker hides
// from it (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_GATHERED_LIGHT_GLSL
#define PASSES_INDIRECT_LPV_GATHERED_LIGHT_GLSL
#include "passes/indirect/lpv/apply/taps.glsl"

layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

layout(constant_id = 4) const uint irradiance = irradiance_face;

// Where cells are a metre wide. face: of a light half a cell away that sends as much as the cell towards the surface. cell: of light through
// all of the cell's section, which is 1.5 square metres in the mean.
float towards(vec4 light, vec3 n) {
    const float face = (4.0 / 3.14159265358979) * (y0 * light.x - y1 * dot(light.yzw, n));
    const float cell = (watt0 * light.x - watt1 * dot(light.yzw, n)) / 1.5;
    return max(0.0, irradiance == irradiance_face ? face : cell);
}

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
    const LightCell light = seen.light;
    if (seen.hidden > 0u) atomicAdd(counters.hidden_taps, seen.hidden);
    if (seen.near > 0u) atomicAdd(counters.samples_near_blockers, 1u);
    if (seen.near > 0u) atomicAdd(counters.blocker_tests, seen.tests);
    const vec3 n = lit.normal;
    const float scale = 1.0 / (grid.cell * grid.cell);
    const vec3 received = scale * vec3(towards(light.red, n), towards(light.green, n), towards(light.blue, n));
    if (damping == 0.0) return received;
    return received * kept_of(light, grid, lit);
}

#endif
