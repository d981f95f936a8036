// From the light of a cell to irradiance on a surface in it (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_IRRADIANCE_GLSL
#define PASSES_INDIRECT_IRRADIANCE_GLSL
#include "passes/indirect/grid.glsl"

layout(constant_id = 72) const uint irradiance = irradiance_face;

// Irradiance over pi, where cells are a meter wide (docs/algorithms/lighting.md 5.8). face: of a light half a cell away that sends as much as the
// cell towards the surface. cell: of light through all of the cell's section, which is 1.5 square meters in the mean. Without a normal
// only l0 is left: the mean over all normals, which is the mean radiance.
float through(vec4 light, vec3 n) {
    const float face = (4.0 / 3.14159265358979) * (y0 * light.x - y1 * dot(light.yzw, n));
    const float cell = (watt0 * light.x - watt1 * dot(light.yzw, n)) / 1.5;
    return irradiance == irradiance_face ? face : cell;
}

float towards(vec4 light, vec3 n) { return max(0.0, through(light, n)); }

vec3 irradiance_over_pi(GridPlace grid, LightCell light, vec3 n) {
    const float scale = 1.0 / (grid.cell * grid.cell);
    return scale * vec3(towards(light.red, n), towards(light.green, n), towards(light.blue, n));
}

// Factor on irradiance, by the way that its sources face (passes/indirect/lpv/channels.glsl): light of a source of normal m counts 1 - m.n
// times. A surface and another one that faces the same way do not see each other, however near they are; two that face each other do.
float share_by_facing(LightCell light, LightCell facing, vec3 n) {
    const vec4 all = (light.red + light.green + light.blue) / 3.0;
    const vec4 alike = n.x * (2.0 * facing.red - all) + n.y * (2.0 * facing.green - all) + n.z * (2.0 * facing.blue - all);
    const float received = through(all, n);
    return received > 0.0 ? clamp(1.0 - through(alike, n) / received, 0.0, 2.0) : 0.0;
}

#endif
