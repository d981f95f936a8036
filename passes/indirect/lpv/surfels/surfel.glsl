// A fragment of a surface as a piece of it. Of a surface that an axis sees at an angle, that axis takes the share cosine^2: the shares of
// the three axes add up to 1, and the pieces to the surface's area, without an axis that a surface belongs to and without pieces that
// grow where they are seen from the side.
#ifndef PASSES_INDIRECT_LPV_SURFEL_GLSL
#define PASSES_INDIRECT_LPV_SURFEL_GLSL
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/shaders/alpha_test.glsl"

layout(push_constant, scalar) uniform Push { SurfelPush push; };

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec4 in_color;
layout(location = 4) flat in uint in_draw;

struct Surfel {
    bool exists;
    vec3 place;      // relative to the eye, along the world's axes
    vec3 normal;     // outward, unit
    vec3 direction;  // across the triangle, unit, of either side
    float area;      // square cells
    vec3 albedo;
    bool has_two_sides;
};

// Whether the map, which looks along an axis, shows front faces as the eye does: it mirrors the world where view space does not.
bool shows_front() { return gl_FrontFacing == determinant(view.to_world) < 0.0; }

Surfel surfel() {
    const MaterialRecord material = material_of(in_draw);
    const MaterialTexels texels = material_texels(draws[in_draw].material, 1u << base_color_texture | 1u << metallic_roughness_texture, footprint(in_uv));
    const vec4 base = material.base_color * in_color * texels.of[base_color_texture];
    const float metallic = has_metals(material.lighting_model) ? material.metallic * texels.of[metallic_roughness_texture].b : 0.0;
    const vec3 across = cross(dFdxFine(in_place), dFdyFine(in_place));  // along the axis
    const vec3 direction = across / length(across);
    const bool is_cut = is_cut_away(material, base.a);
    const vec3 outward = dot(in_normal, in_normal) > 0.0 ? normalize(in_normal) : shows_front() ? -direction : direction;
    const float area = abs(direction[push.axis]) / float(surfels_a_side * surfels_a_side);
    const bool exists = !is_cut && area >= 0.0 && dot(outward, outward) > 0.5;  // neither is NaN
    const vec3 albedo = material.lighting_model == model_unlit ? vec3(0.0) : clamp(base.rgb * (1.0 - metallic), 0.0, 1.0);
    return Surfel(exists, in_place, outward, direction, area, albedo, !has_one_side(material.double_sided));
}

#endif
