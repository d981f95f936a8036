// The fragment shader of every G-buffer technique. Included last: inputs_at_center.glsl or inputs_at_sample.glsl says where
// attributes are shaded, the technique's encode.glsl how they are stored. Coverage and depth are always per sample.
#ifndef PASSES_GBUFFER_FILL_GLSL
#define PASSES_GBUFFER_FILL_GLSL
#include "passes/gbuffer/coverage/coverage.glsl"
#include "passes/shaders/largest_half.glsl"
#include "passes/shaders/material.glsl"

layout(location = 7) flat in uint in_triangle;  // the vertex that it begins with

layout(location = 2) out vec4 emission;

// Bit i: the alpha test leaves sample i. Of hardware's coverage depth tells.
uint left_samples(MaterialRecord material, float alpha, float vertex_alpha) {
    if (masked == masked_hardware) return every_sample;
    if (masked == masked_clip) return is_cut_away(material, alpha) ? 0u : every_sample;
    const uint number = draws[in_draw].material, surface = mask_surface(in_draw, in_triangle);
    const uint covered = covered_samples(material, number, varying_uv(), vertex_alpha, surface);
    return is_masked(material) ? covered : every_sample;
}

// A function, so that shaders without it have no mask at all (passes/graph/reached_code.h).
void keep_samples(uint left) { gl_SampleMask[0] = int(left); }

// Discards backs of one-sided faces and what the alpha test cuts away. Material and test are evaluated first: derivatives need
// the whole quad.
MaterialPoint visible_point() {
    const MaterialRecord material = material_of(in_draw);
    const Varyings v = varyings();
    const MaterialPoint m = material_point(in_draw, varying_uv(), v);
    const uint left = left_samples(material, m.alpha, v.color.a);
    if (!gl_FrontFacing && has_one_side(material.double_sided)) discard;
    if (left == 0u) discard;
    if (masked != masked_clip && mask_samples > 1u) keep_samples(left);
    return m;
}

// Radiance that no light causes; an unlit surface's color is its radiance. a = 1 says that there is a surface.
vec4 emitted(MaterialPoint m) {
    const vec3 own = m.lighting_model == model_unlit ? m.base_color * view.pre_exposure + m.emissive : m.emissive;
    return vec4(min(own, largest_half), 1.0);
}

void main() {
    const MaterialPoint m = visible_point();
    encode(m);
    emission = emitted(m);
}

#endif
