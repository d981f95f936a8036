// Notes pixels in which a visible triangle does not cover every sample (docs/algorithms/deferred.md 3.2, D3). Drawn over the
// finished depth, so that only triangles with a visible sample get here; coverage is the rasterizer's, before the depth test.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/alpha_test.glsl"

layout(early_fragment_tests) in;
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 6) flat in uint in_draw;

layout(constant_id = 1) const int full_coverage = 15;

layout(set = 0, binding = 0, r8ui) writeonly uniform uimage2D partly;

// The surfaces that the G-buffer has with masked=clip: no backs of one-sided faces, nothing that the alpha test cuts away.
bool is_drawn() {
    const MaterialRecord material = material_of(in_draw);
    const MaterialPoint m = material_point(in_draw, in_uv, Varyings(in_position, in_normal, in_tangent, in_color, gl_FrontFacing));
    if (!gl_FrontFacing && has_one_side(material.double_sided)) return false;
    return !is_cut_away(material, m.alpha);
}

void main() {
    const bool is_partial = gl_SampleMaskIn[0] != full_coverage;
    if (is_drawn() && is_partial) imageStore(partly, ivec2(gl_FragCoord.xy), uvec4(1u));
}
