// What the frame's meshes and materials have (passes/scene/material_uses.h), for vertex and fragment shaders: the rest is compiled away.
#ifndef PASSES_SHADERS_USES_GLSL
#define PASSES_SHADERS_USES_GLSL
#include "passes/shaders/scene.glsl"
#include "passes/shaders/uses.shared.h"

const uint every_texture = (1u << texture_kinds) - 1u;

layout(constant_id = 9) const uint drawn = meshes_drawn | particles_drawn;
layout(constant_id = 20) const uint used_textures = every_texture;
layout(constant_id = 50) const uint used_models = 0xffffffffu;
layout(constant_id = 51) const uint used_alpha_modes = 0xffffffffu;
layout(constant_id = 52) const uint used_properties = 0xffffffffu;
layout(constant_id = 53) const uint used_attributes = 0xffffffffu;

bool is_emitter(uint draw) { return drawn == particles_drawn || drawn != meshes_drawn && draw >= view.first_emitter; }

bool is_used(uint texture_kind) { return (used_textures & (1u << texture_kind)) != 0u; }

bool has_attribute(uint bit) { return (used_attributes & bit) != 0u; }

bool has_property(uint bit) { return (used_properties & bit) != 0u; }

bool has_one_side(uint double_sided) { return !has_property(property_both_sides) || has_property(property_one_side) && double_sided == 0u; }

// A value that is known where all materials have it.
uint the_one(uint bits, uint value) { return bits != 0u && (bits & (bits - 1u)) == 0u ? uint(findLSB(bits)) : value; }

// A material with what the constants say of all: the same values, of which a shader need not read them.
MaterialRecord as_used(MaterialRecord material) {
    material.lighting_model = the_one(used_models, material.lighting_model);
    material.alpha_mode = the_one(used_alpha_modes, material.alpha_mode);
    if (!has_property(property_metallic)) material.metallic = 0.0;
    if (!has_property(property_emissive)) material.emissive = vec3(0.0);
    if (!has_property(property_transmission)) material.transmission = vec3(0.0);
    return material;
}

#endif
