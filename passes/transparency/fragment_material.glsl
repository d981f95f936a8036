// The material under a sample of a transparent surface. What all fragments of a draw share comes with its vertices, flat: llvmpipe reads a
// storage buffer lane by lane, and two thirds of a fragment's time went into reading the same records again.
#ifndef PASSES_TRANSPARENCY_FRAGMENT_MATERIAL_GLSL
#define PASSES_TRANSPARENCY_FRAGMENT_MATERIAL_GLSL
#include "passes/shaders/material.glsl"

// As draw_vertex.glsl hands them on where it hands on materials.
layout(location = 8) flat in vec4 in_base_color;
layout(location = 9) flat in uvec4 in_modes;
layout(location = 10) flat in uvec4 in_texture;
layout(location = 11) flat in uvec4 in_texture_use;
layout(location = 12) flat in vec4 in_row0;
layout(location = 13) flat in vec4 in_row1;

float soft_fade_meters() { return in_row0.w; }
float distortion_here() { return in_row1.w; }
uint layer_here() { return in_modes.w; }

MaterialRecord material_here(uint draw) {
    MaterialRecord material = materials[draws[draw].material];
    material.base_color = in_base_color;
    material.alpha_mode = in_modes.x;
    material.lighting_model = in_modes.y;
    return as_used(material);
}

// The texture of the base color, which nearly all transparent surfaces have and often no other.
vec4 base_color_texel(Footprint f) {
    const TextureUseRecord use = TextureUseRecord(in_texture_use.w, in_texture_use.z, in_row0.xyz, in_row1.xyz);
    if (!is_used(base_color_texture) || use.texture == no_index) return vec4(1.0);
    return texture_at(TextureRecord(in_texture.x, in_texture.y, in_texture.z, in_texture.w, in_texture_use.x, in_texture_use.y), use, f);
}

// The varyings uv0, uv1 at the sample.
MaterialPoint material_point_here(uint draw, vec4 uv, Varyings v) {
    const Footprint f = footprint(uv);
    MaterialTexels texels = material_texels(draws[draw].material, every_texture & ~(1u << base_color_texture), f);
    texels.of[base_color_texture] = base_color_texel(f);
    return material_point(draw, material_here(draw), texels, v);
}

#endif
