// Of the opaque surface that is seen: drawn once more against the depth that it has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/alpha_test.glsl"
#include "passes/transparency/functions/motion.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uv;
layout(location = 4) in vec4 in_color;
layout(location = 6) flat in uint in_draw;

layout(location = 0) out vec4 out_motion;

void main() {
    const MaterialRecord material = material_of(in_draw);
    const MaterialPoint m = material_point(in_draw, in_uv, Varyings(in_position, in_normal, in_tangent, in_color, gl_FrontFacing));
    if (!gl_FrontFacing && has_one_side(material.double_sided)) discard;
    if (is_cut_away(material, m.alpha)) discard;
    out_motion = vec4(pixels_moved(in_position, in_draw), 0.0, 0.0);
}
