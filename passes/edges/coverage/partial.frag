// Notes pixels in which a visible triangle does not cover every sample (docs/algorithms/deferred.md 3.2, D3). Drawn where the
// finished depth is equal, so that only triangles with a visible sample get here; coverage is the rasterizer's, before the depth
// test, and what the G-buffer's mask leaves of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/coverage/coverage.glsl"

layout(early_fragment_tests) in;
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 6) flat in uint in_draw;
layout(location = 7) flat in uint in_triangle;  // the vertex that it begins with

layout(constant_id = 1) const int full_coverage = 15;

layout(set = 0, binding = 0, r8ui) writeonly uniform uimage2D partly;

// Which samples the device's alpha to coverage takes is its secret: an alpha between 0 and 1 counts as one of those that the
// triangle covers.
uint taken_by_hardware(float alpha) {
    if (alpha <= 0.0) return 0u;
    return alpha >= 1.0 ? every_sample : 1u << findLSB(gl_SampleMaskIn[0]);
}

// The samples that the G-buffer's mask leaves (passes/gbuffer/fill.glsl). No back of a one-sided face has any.
uint left_samples() {
    const MaterialRecord material = material_of(in_draw);
    const MaterialPoint m = material_point(in_draw, in_uv, Varyings(in_position, in_normal, in_tangent, in_color, gl_FrontFacing));
    uint left = is_cut_away(material, m.alpha) ? 0u : every_sample;
    if (masked == masked_hardware) left = taken_by_hardware(m.alpha);
    else if (masked != masked_clip)
        left = covered_samples(material, draws[in_draw].material, in_uv, in_color.a, mask_surface(in_draw, in_triangle));
    if (!is_masked(material)) left = every_sample;
    return !gl_FrontFacing && has_one_side(material.double_sided) ? 0u : left;
}

void main() {
    const int covered = gl_SampleMaskIn[0] & int(left_samples());
    if (covered != 0 && covered != full_coverage) imageStore(partly, ivec2(gl_FragCoord.xy), uvec4(1u));
}
