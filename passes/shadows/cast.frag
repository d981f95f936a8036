// Only depth is kept; masked casters have holes where the G-buffer has them, at the map's own level of detail.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/material.glsl"

layout(location = 0) in vec4 in_uv;
layout(location = 1) in float in_alpha;
layout(location = 2) flat in uint in_draw;

void main() {
    const Footprint uv = footprint(in_uv);
    const MaterialRecord material = material_of(in_draw);
    if (material.alpha_mode != alpha_mask) return;
    float alpha = material.base_color.a * in_alpha;
    if (is_used(base_color_texture)) alpha *= texture_at(material.textures[base_color_texture], uv).a;
    if (alpha < material.mask_cutoff) discard;
}
