// Only depth is kept; masked casters have holes where the G-buffer has them, at the map's own level of detail.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/alpha_test.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 2) flat in uint in_draw;

void main() {
    const Footprint uv = footprint(in_uv);
    const MaterialRecord material = material_of(in_draw);
    if (!is_masked(material)) return;
    if (is_cut_away(material, alpha_of(material, uv, in_alpha))) discard;
}
