// What opaque surfaces take of the grid that a step is given.
#ifndef PASSES_INDIRECT_LPV_TAPS_GLSL
#define PASSES_INDIRECT_LPV_TAPS_GLSL
#include "passes/gbuffer/surface.glsl"
#include "passes/indirect/read_grid.glsl"

layout(constant_id = 3) const uint asks_taps = 0u;  // 1: not of cells that a blocker hides

layout(set = 0, binding = 0, scalar) readonly buffer Total { LightCell total[]; };

LightCell light_of(uint number) { return total[number]; }

LitPlace lit_place(Surface s, uvec2 pixel) {
    const MaterialPoint m = lit_point(s, pixel);
    return LitPlace(view.to_world * m.position, view.to_world * facing_normal(m.lighting_model, m.normal, m.position));
}

SeenLight seen_light(GridPlace grid, LitPlace lit) { return seen_light(grid, 0u, lit, asks_taps != 0u); }

#endif
