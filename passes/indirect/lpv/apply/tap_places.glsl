// Where surfaces of the G-buffer read the cells of a grid.
#ifndef PASSES_INDIRECT_LPV_TAP_PLACES_GLSL
#define PASSES_INDIRECT_LPV_TAP_PLACES_GLSL
#include "passes/gbuffer/surface.glsl"
#include "passes/indirect/lpv/apply/listed_blockers.glsl"

layout(constant_id = 7) const float damping = 0.0;  // above 0 cells behind the surface are read, too

LitPlace lit_place(Surface s, uvec2 pixel) {
    const MaterialPoint m = lit_point(s, pixel);
    return LitPlace(view.to_world * m.position, view.to_world * facing_normal(m.lighting_model, m.normal, m.position));
}

#endif
