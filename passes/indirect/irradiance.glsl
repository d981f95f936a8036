// From the light of a cell to irradiance on a surface in it (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_IRRADIANCE_GLSL
#define PASSES_INDIRECT_IRRADIANCE_GLSL
#include "passes/indirect/grid.glsl"

layout(constant_id = 72) const uint irradiance = irradiance_face;

// Irradiance over pi, where cells are a meter wide (docs/algorithms/lighting.md 5.8). face: of a light half a cell away that sends as much as the
// cell towards the surface. cell: of light through all of the cell's section, which is 1.5 square meters in the mean. Without a normal
// only l0 is left: the mean over all normals, which is the mean radiance.
float towards(vec4 light, vec3 n) {
    const float face = (4.0 / 3.14159265358979) * (y0 * light.x - y1 * dot(light.yzw, n));
    const float cell = (watt0 * light.x - watt1 * dot(light.yzw, n)) / 1.5;
    return max(0.0, irradiance == irradiance_face ? face : cell);
}

vec3 irradiance_over_pi(GridPlace grid, LightCell light, vec3 n) {
    const float scale = 1.0 / (grid.cell * grid.cell);
    return scale * vec3(towards(light.red, n), towards(light.green, n), towards(light.blue, n));
}

#endif
