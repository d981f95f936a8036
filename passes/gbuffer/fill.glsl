// What every G-buffer technique's fragment shader starts from: the visible material point, and its emission. One invocation
// per pixel and triangle: attributes are the pixel center's, coverage and depth are per sample.
#ifndef PASSES_GBUFFER_FILL_GLSL
#define PASSES_GBUFFER_FILL_GLSL
#include "passes/gbuffer/codes.glsl"
#include "passes/gbuffer/coverage/coverage.glsl"
#include "passes/shaders/largest_half.glsl"
#include "passes/shaders/material.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 6) flat in uint in_draw;
layout(location = 7) flat in uint in_triangle;  // the vertex that it begins with

layout(location = 0) out vec4 gbuffer0;
layout(location = 1) out vec4 gbuffer1;
layout(location = 2) out vec4 emission;

// Bit i: the alpha test leaves sample i.
uint left_samples(MaterialRecord material, float alpha) {
    if (masked == masked_clip) return is_cut_away(material, alpha) ? 0u : every_sample;
    const uint covered = covered_samples(material, draws[in_draw].material, in_uv, in_color.a, mask_surface(in_draw, in_triangle));
    return is_masked(material) ? covered : every_sample;
}

// Discards backs of one-sided faces and what the alpha test cuts away. Material and test are evaluated first: derivatives need
// the whole quad.
MaterialPoint visible_point() {
    const MaterialRecord material = material_of(in_draw);
    const MaterialPoint m = material_point(in_draw, in_uv, Varyings(in_position, in_normal, in_tangent, in_color, gl_FrontFacing));
    const uint left = left_samples(material, m.alpha);
    if (!gl_FrontFacing && has_one_side(material.double_sided)) discard;
    if (left == 0u) discard;
    if (masked != masked_clip && mask_samples > 1u) gl_SampleMask[0] = int(left);
    return m;
}

// Radiance that no light causes; an unlit surface's color is its radiance. a = 1 says that there is a surface.
vec4 emitted(MaterialPoint m) {
    const vec3 own = m.lighting_model == model_unlit ? m.base_color + m.emissive : m.emissive;
    return vec4(min(own, largest_half), 1.0);
}

#endif
