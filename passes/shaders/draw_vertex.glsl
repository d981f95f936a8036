// A vertex of the scene as draw.vert hands it on: for vertex shaders that say more than that one.
#ifndef PASSES_SHADERS_DRAW_VERTEX_GLSL
#define PASSES_SHADERS_DRAW_VERTEX_GLSL
#include "passes/shaders/vertex.glsl"

layout(location = 0) out vec3 out_position;  // view space
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec4 out_uv;        // uv0, uv1
layout(location = 4) out vec4 out_color;
layout(location = 5) out vec4 out_emissive;  // w: depth offset towards the eye
layout(location = 6) flat out uint out_draw;
layout(location = 7) flat out uint out_triangle;  // its number in the draw where numbered_draw.vert draws; else its first vertex

// 1: the fragments read the material of their draw from here (passes/transparency/fragment_material.glsl), once per vertex.
layout(constant_id = 40) const uint hands_on_material = 0u;
layout(location = 8) flat out vec4 out_base_color;
layout(location = 9) flat out uvec4 out_modes;         // alpha_mode, lighting_model, double_sided; the draw's layer
layout(location = 10) flat out uvec4 out_texture;      // of the base color: first, format, width, height
layout(location = 11) flat out uvec4 out_texture_use;  // mips, sampling; uv_set, texture
layout(location = 12) flat out vec4 out_row0;          // w: the draw's soft_fade
layout(location = 13) flat out vec4 out_row1;          // w: distortion

// The same bits in every pass: depth tests compare with what another shader wrote.
invariant gl_Position;

vec3 view_position(uint vertex, uint draw) { return (draws[draw].to_view * vec4(position_of(vertex, draw), 1.0)).xyz; }

void hand_on_material(DrawRecord d) {
    const MaterialRecord m = as_used(materials[d.material]);
    TextureUseRecord use = TextureUseRecord(no_index, 0u, vec3(0.0), vec3(0.0));
    if (is_used(base_color_texture)) use = m.textures[base_color_texture];
    TextureRecord t = TextureRecord(0u, 0u, 1u, 1u, 1u, 0u);
    if (use.texture != no_index) t = textures[use.texture];
    out_base_color = m.base_color;
    out_modes = uvec4(m.alpha_mode, m.lighting_model, m.double_sided, d.layer);
    out_texture = uvec4(t.first, t.format, t.width, t.height);
    out_texture_use = uvec4(t.mips, t.sampling, use.uv_set, use.texture);
    out_row0 = vec4(use.row0, d.soft_fade);
    out_row1 = vec4(use.row1, m.distortion);
}

void hand_on(uint vertex, uint draw) {
    const Vertex v = vertex_of(vertex, draw);
    const DrawRecord d = draws[draw];
    out_position = (d.to_view * vec4(v.position, 1.0)).xyz;
    out_normal = d.normal_to_view * v.normal;
    out_tangent = vec4(mat3(d.to_view) * v.tangent.xyz, v.tangent.w);
    out_uv = vec4(v.uv0, v.uv1);
    out_color = v.color;
    out_emissive = vec4(v.emissive, v.depth_offset);
    out_draw = draw;
    out_triangle = vertex - d.vertex_offset;
    if (hands_on_material != 0u) hand_on_material(d);
    gl_Position = view.projection * vec4(out_position, 1.0);
}

#endif
