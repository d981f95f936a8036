// Only depth is kept. Rain falls through the holes of masked casters, at the map's own level of detail.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/alpha_test.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 2) flat in uint in_draw;

void main() {
    const MaterialRecord material = material_of(in_draw);
    const float alpha = alpha_of(material, footprint(in_uv), in_alpha);
    if (is_cut_away(material, alpha)) discard;
}
