// The fragment shader of every G-buffer technique. Included last: inputs_at_center.glsl or inputs_at_sample.glsl says where
// attributes are shaded, the technique's encode.glsl how they are stored. Coverage and depth are always per sample.
#ifndef PASSES_GBUFFER_FILL_GLSL
#define PASSES_GBUFFER_FILL_GLSL
#include "passes/shaders/largest_half.glsl"
#include "passes/shaders/material.glsl"

layout(location = 2) out vec4 emission;

// Discards backs of one-sided faces and what the alpha test cuts away. The material is evaluated first: derivatives need the
// whole quad.
MaterialPoint visible_point() {
    const MaterialRecord material = material_of(in_draw);
    const MaterialPoint m = material_point(in_draw, varying_uv(), varyings());
    if (!gl_FrontFacing && has_one_side(material.double_sided)) discard;
    if (m.alpha_mode == alpha_mask && m.alpha < material.mask_cutoff) discard;
    return m;
}

// Radiance that no light causes; an unlit surface's color is its radiance. a = 1 says that there is a surface.
vec4 emitted(MaterialPoint m) {
    const vec3 own = m.lighting_model == model_unlit ? m.base_color + m.emissive : m.emissive;
    return vec4(min(own, largest_half), 1.0);
}

void main() {
    const MaterialPoint m = visible_point();
    encode(m);
    emission = emitted(m);
}

#endif
