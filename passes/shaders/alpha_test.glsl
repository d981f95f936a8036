// Alpha of a material, and the test that cuts masked surfaces away at one point. Fragment shaders only.
#ifndef PASSES_SHADERS_ALPHA_TEST_GLSL
#define PASSES_SHADERS_ALPHA_TEST_GLSL
#include "passes/shaders/material.glsl"

bool is_masked(MaterialRecord material) { return material.alpha_mode == alpha_mask; }

// glTF 2.0, 3.9.4: what is not below the cutoff is opaque.
bool is_cut_away(MaterialRecord material, float alpha) { return is_masked(material) && alpha < material.mask_cutoff; }

// The same product as MaterialPoint::alpha, without the rest of the material.
float alpha_of(MaterialRecord material, Footprint f, float vertex_alpha) {
    float alpha = material.base_color.a * vertex_alpha;
    if (is_used(base_color_texture)) alpha *= texture_at(material.textures[base_color_texture], f).a;
    return alpha;
}

#endif
