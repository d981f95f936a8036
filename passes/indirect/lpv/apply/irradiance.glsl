// What the light of cells gives a surface.
#ifndef PASSES_INDIRECT_LPV_IRRADIANCE_GLSL
#define PASSES_INDIRECT_LPV_IRRADIANCE_GLSL
#include "passes/indirect/lpv/harmonics.glsl"
#include "passes/indirect/lpv/lpv.shared.h"

layout(constant_id = 4) const uint irradiance = irradiance_face;

// Irradiance over pi, where cells are a metre wide (docs/algorithms/lighting.md 5.8). face: of a light half a cell away that sends as much as the
// cell towards the surface. cell: of light through all of the cell's section, which is 1.5 square metres in the mean.
float towards(vec4 light, vec3 n) {
    const float face = (4.0 / 3.14159265358979) * (y0 * light.x - y1 * dot(light.yzw, n));
    const float cell = (watt0 * light.x - watt1 * dot(light.yzw, n)) / 1.5;
    return max(0.0, irradiance == irradiance_face ? face : cell);
}

#endif
