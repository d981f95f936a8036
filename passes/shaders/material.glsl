// Materials evaluated into a MaterialPoint from the varyings of draw.vert, with their textures. Fragment shaders only
// (derivatives): call before any branch that leaves the quad.
#ifndef PASSES_SHADERS_MATERIAL_GLSL
#define PASSES_SHADERS_MATERIAL_GLSL
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/texture.glsl"
#include "passes/shaders/uses.glsl"

// The varyings uv0, uv1 with their derivatives. These are taken of the varyings alone: lavapipe 22.3 reads buffers as 0 in
// helper lanes, so anything that went through a buffer (a size, a transform) has no derivative along a triangle's edge.
struct Footprint {
    vec4 uv, dx, dy;
};

Footprint footprint(vec4 uv) { return Footprint(uv, dFdxFine(uv), dFdyFine(uv)); }

// log2 of the longer side of the pixel's footprint in texels of the finest mip, 0 where it is magnified.
float level_of_detail(TextureRecord t, vec2 dx, vec2 dy) {
    const vec2 size = vec2(t.width, t.height);
    const float side = max(length(dx * size), length(dy * size));
    return max(log2(max(side, 1.0)), 0.0);
}

// The same of a use of the texture, whose transform turns and stretches the footprint.
float level_of_detail(TextureRecord t, TextureUseRecord use, Footprint f) {
    const bool first = use.uv_set == 0u;
    const vec2 dx = first ? f.dx.xy : f.dx.zw, dy = first ? f.dy.xy : f.dy.zw;
    const mat2 turn = mat2(use.row0.x, use.row1.x, use.row0.y, use.row1.y);
    return level_of_detail(t, turn * dx, turn * dy);
}

// A texture at (uv0, uv1), the transform of its use applied.
vec4 texture_at(TextureRecord t, TextureUseRecord use, Footprint f) {
    const vec3 uv = vec3(use.uv_set == 0u ? f.uv.xy : f.uv.zw, 1.0);
    return filtered(t, vec2(dot(use.row0, uv), dot(use.row1, uv)), level_of_detail(t, use, f));
}

// White where there is none.
vec4 texture_at(TextureUseRecord use, Footprint f) {
    return use.texture == no_index ? vec4(1.0) : texture_at(textures[use.texture], use, f);
}

// A material's textures by kind, white but for `kinds` (bits). One loop, because drivers inline: five calls took lavapipe twice as long to translate.
struct MaterialTexels {
    vec4 of[texture_kinds];
};

MaterialTexels material_texels(uint material, uint kinds, Footprint f) {
    MaterialTexels texels;
    for (uint kind = 0u; kind < texture_kinds; ++kind) texels.of[kind] = vec4(1.0);
    for (uint left = used_textures & kinds; left != 0u; left &= left - 1u) {
        const uint kind = uint(findLSB(left));
        texels.of[kind] = texture_at(materials[material].textures[kind], f);
    }
    return texels;
}

// The triangle's own outward normal, for meshes without normals (they are 0 there).
vec3 face_normal(vec3 position, bool front_facing) {
    const vec3 n = normalize(cross(dFdxFine(position), dFdyFine(position)));
    return (dot(n, position) < 0.0) == front_facing ? n : -n;
}

// The bitangent is made in the right-handed object space (glTF 2.0, 3.7.2.1: cross(normal, tangent) * w) and carried to view
// space, where a cross product has the sign of the transform's determinant. The tangent is made perpendicular first.
vec3 mapped_normal(uint draw, MaterialRecord material, vec3 n, vec4 tangent, vec3 texel) {
    if (!is_used(normal_texture) || material.textures[normal_texture].texture == no_index) return n;
    vec3 local = texel * 2.0 - 1.0;
    local.xy *= material.normal_scale;
    const vec3 across = tangent.xyz - n * dot(n, tangent.xyz);
    if (dot(across, across) < 1e-20) return n;
    const vec3 t = normalize(across);
    const float hand = determinant(mat3(draws[draw].to_view)) < 0.0 ? -tangent.w : tangent.w;
    return normalize(t * local.x + cross(n, t) * (hand * local.y) + n * local.z);
}

// Hair's tangent runs along its fibers; fibers without one stick out.
vec3 fiber(vec3 normal, vec4 tangent) { return dot(tangent.xyz, tangent.xyz) < 1e-20 ? normal : normalize(tangent.xyz); }

// The varyings of draw.vert, as they are, but for uv.
struct Varyings {
    vec3 position, normal;
    vec4 tangent, color;
    bool front_facing;
};

// A normal of a back face is turned around.
MaterialPoint material_point(uint draw, MaterialRecord material, MaterialTexels texels, Varyings v) {
    const vec4 base = material.base_color * v.color * texels.of[base_color_texture];
    const vec4 surface = texels.of[metallic_roughness_texture];
    const vec3 outward = dot(v.normal, v.normal) > 0.0 ? normalize(v.normal) : face_normal(v.position, v.front_facing);
    const vec3 facing = mapped_normal(draw, material, outward, v.tangent, texels.of[normal_texture].xyz);
    MaterialPoint m;
    m.position = v.position;
    m.normal = v.front_facing ? facing : -facing;
    if (material.lighting_model == model_hair) m.normal = fiber(m.normal, v.tangent);
    m.base_color = base.rgb;
    m.alpha = base.a;
    m.metallic = has_metals(material.lighting_model) ? material.metallic * surface.b : 0.0;
    m.roughness = material.roughness * surface.g;
    m.occlusion = 1.0;
    if (is_used(occlusion_texture)) m.occlusion += material.occlusion_strength * (texels.of[occlusion_texture].r - 1.0);
    m.emissive = material.emissive * texels.of[emissive_texture].rgb;
    m.transmission = material.transmission;
    m.lighting_model = material.lighting_model;
    m.alpha_mode = material.alpha_mode;
    return m;
}

MaterialRecord material_of(uint draw) { return as_used(materials[draws[draw].material]); }

// With everything read from the material of the draw.
MaterialPoint material_point(uint draw, vec4 uv, Varyings v) {
    return material_point(draw, material_of(draw), material_texels(draws[draw].material, every_texture, footprint(uv)), v);
}

#endif
