// What a light sees: where, which way it faces, and what of the light it reflects (Dachsbacher and Stamminger, Reflective Shadow
// Maps, I3D 2005). Every surface reflects as Lambert's does, no more than arrives; an unlit one reflects nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/shaders/alpha_test.glsl"

layout(push_constant, scalar) uniform Push { MapPush push; };

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec4 in_color;
layout(location = 4) flat in uint in_draw;

layout(location = 0) out vec4 position;  // view space; w: 1, there is a surface
layout(location = 1) out vec4 normal;    // view space, unit
layout(location = 2) out vec4 albedo;

// Whether a grid may take what a place reflects; if not, all that counts is that it stands before others.
bool may_be_taken(vec3 place) {
    const vec3 relative = view.to_world * place;
    return all(greaterThanEqual(relative, push.low)) && all(lessThanEqual(relative, push.high));
}

void main() {
    const MaterialRecord material = material_of(in_draw);
    const Footprint covered = footprint(in_uv);
    const vec3 outward = dot(in_normal, in_normal) > 0.0 ? normalize(in_normal) : face_normal(in_position, gl_FrontFacing);
    position = normal = albedo = vec4(0.0);
    if (!is_masked(material) && !may_be_taken(in_position)) return;
    const MaterialTexels texels = material_texels(draws[in_draw].material, 1u << base_color_texture | 1u << metallic_roughness_texture, covered);
    const vec4 base = material.base_color * in_color * texels.of[base_color_texture];
    if (is_cut_away(material, base.a)) discard;
    const float metallic = has_metals(material.lighting_model) ? material.metallic * texels.of[metallic_roughness_texture].b : 0.0;
    position = vec4(in_position, 1.0);
    normal = vec4(outward, 0.0);
    albedo = vec4(material.lighting_model == model_unlit ? vec3(0.0) : clamp(base.rgb * (1.0 - metallic), 0.0, 1.0), 0.0);
}
