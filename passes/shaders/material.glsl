// Materials: textures filtered from the texel buffer in shader code, so that every device filters alike, and evaluated into a
// MaterialPoint from the varyings of draw.vert. Fragment shaders only (derivatives): call before any branch that leaves the quad.
#ifndef PASSES_SHADERS_MATERIAL_GLSL
#define PASSES_SHADERS_MATERIAL_GLSL
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/scene.glsl"
#include "passes/shaders/srgb.glsl"

// What the frame's materials use (passes/texture_uses.h); the rest is compiled away.
layout(constant_id = 20) const uint used_textures = 0xffffffffu;
layout(constant_id = 21) const uint used_formats = 0xffffffffu;

bool is_used(uint kind) { return (used_textures & (1u << kind)) != 0u; }

// TextureFormat and AddressMode of capture_format/frame.h.
const uint texture_rgba8_unorm = 0u;
const uint texture_rgba8_srgb = 1u;
const uint texture_rgba16f = 2u;
const uint texture_rgba32f = 3u;
const uint address_repeat = 0u;
const uint address_clamp = 1u;

bool has_format(uint format) { return (used_formats & (1u << format)) != 0u; }

uint words_per_texel(uint format) { return format <= texture_rgba8_srgb ? 1u : format == texture_rgba16f ? 2u : 4u; }

vec4 texel(TextureRecord t, uint index) {
    const uint at = t.first + index * words_per_texel(t.format);
    vec4 value = vec4(0.0);
    if (t.format <= texture_rgba8_srgb && (has_format(texture_rgba8_unorm) || has_format(texture_rgba8_srgb))) {
        value = unpackUnorm4x8(texels[at]);
        if (has_format(texture_rgba8_srgb) && t.format == texture_rgba8_srgb) value.rgb = srgb_to_linear(value.rgb);
    } else if (has_format(texture_rgba16f) && t.format == texture_rgba16f) {
        value = vec4(unpackHalf2x16(texels[at]), unpackHalf2x16(texels[at + 1u]));
    } else if (has_format(texture_rgba32f) && t.format == texture_rgba32f) {
        value = uintBitsToFloat(uvec4(texels[at], texels[at + 1u], texels[at + 2u], texels[at + 3u]));
    }
    return value;
}

// i modulo n in 0..n-1. GLSL leaves % of negative numbers undefined and allows division 2.5 ULP, hence the corrections.
ivec4 modulo(ivec4 i, ivec4 n) {
    ivec4 rest = i - n * ivec4(floor(vec4(i) / vec4(n)));
    rest += n * ivec4(lessThan(rest, ivec4(0)));
    rest -= n * ivec4(greaterThanEqual(rest, n));
    return clamp(rest, ivec4(0), n - 1);
}

// Texels i of n, inside. Every second turn of a mirrored texture runs backwards.
ivec4 wrapped(ivec4 i, ivec4 n, uint address) {
    const ivec4 turn = modulo(i, address == address_repeat ? n : 2 * n);
    return address == address_clamp ? clamp(i, ivec4(0), n - 1) : min(turn, 2 * n - 1 - turn);
}

// One mip, bilinear: texel centers at +.5. sRGB decodes before filtering.
vec4 bilinear(TextureRecord t, uint mip, vec2 uv) {
    uint base = 0u;
    for (uint m = 0u; m < mip; ++m) base += max(1u, t.width >> m) * max(1u, t.height >> m);
    const ivec2 size = max(ivec2(1), ivec2(t.width >> mip, t.height >> mip));
    const vec2 at = uv * vec2(size) - 0.5;
    const vec2 corner = floor(at);
    const vec2 f = at - corner;
    const ivec2 low = ivec2(corner);
    const uvec4 corners = uvec4(wrapped(ivec4(low, low + 1), size.xyxy, t.address));  // x, y low, x, y high
    vec4 upper = vec4(0.0), lower = vec4(0.0);
    for (uint row = 0u; row < 2u; ++row) {
        const uint first = base + (row == 0u ? corners.y : corners.w) * uint(size.x);
        upper = lower;
        lower = mix(texel(t, first + corners.x), texel(t, first + corners.z), f.x);
    }
    return mix(upper, lower, f.y);
}

// The varyings uv0, uv1 with their derivatives. These are taken of the varyings alone: lavapipe 22.3 reads buffers as 0 in
// helper lanes, so anything that went through a buffer (a size, a transform) has no derivative along a triangle's edge.
struct Footprint {
    vec4 uv, dx, dy;
};

Footprint footprint(vec4 uv) { return Footprint(uv, dFdxFine(uv), dFdyFine(uv)); }

// log2 of the longer side of the pixel's footprint in texels of the finest mip, within the mips there are.
float level_of_detail(TextureRecord t, vec2 dx, vec2 dy) {
    const vec2 size = vec2(t.width, t.height);
    const float side = max(length(dx * size), length(dy * size));
    return clamp(log2(max(side, 1.0)), 0.0, float(t.mips - 1u));
}

vec4 trilinear(TextureRecord t, vec2 uv, float lod) {
    const float finer = floor(lod);
    vec4 fine = vec4(0.0), coarse = vec4(0.0);
    const uint mips = lod == finer ? 1u : 2u;
    for (uint i = 0u; i < mips; ++i) {
        fine = coarse;
        coarse = bilinear(t, uint(finer) + i, uv);
    }
    return mips == 1u ? coarse : mix(fine, coarse, lod - finer);
}

// The texture of a use at (uv0, uv1), its transform applied; white where there is none.
vec4 texture_at(TextureUseRecord use, Footprint f) {
    if (use.texture == no_index) return vec4(1.0);
    const bool first = use.uv_set == 0u;
    const vec3 uv = vec3(first ? f.uv.xy : f.uv.zw, 1.0);
    const vec2 dx = first ? f.dx.xy : f.dx.zw, dy = first ? f.dy.xy : f.dy.zw;
    const mat2 turn = mat2(use.row0.x, use.row1.x, use.row0.y, use.row1.y);
    const TextureRecord t = textures[use.texture];
    return trilinear(t, vec2(dot(use.row0, uv), dot(use.row1, uv)), level_of_detail(t, turn * dx, turn * dy));
}

// A material's textures by kind. One loop, because drivers inline: five calls took lavapipe twice as long to translate.
struct MaterialTexels {
    vec4 of[texture_kinds];
};

MaterialTexels material_texels(uint material, Footprint f) {
    MaterialTexels texels;
    for (uint kind = 0u; kind < texture_kinds; ++kind) texels.of[kind] = vec4(1.0);
    for (uint left = used_textures & ((1u << texture_kinds) - 1u); left != 0u; left &= left - 1u) {
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

// Hair's tangent runs along its fibres; fibres without one stick out.
vec3 fibre(vec3 normal, vec4 tangent) { return dot(tangent.xyz, tangent.xyz) < 1e-20 ? normal : normalize(tangent.xyz); }

// The varyings of draw.vert, as they are. A normal of a back face is turned around.
MaterialPoint material_point(uint draw, vec3 position, vec3 normal, vec4 tangent, vec4 varying_uv, vec4 color, bool front_facing) {
    const MaterialRecord material = materials[draws[draw].material];
    const MaterialTexels texels = material_texels(draws[draw].material, footprint(varying_uv));
    const vec4 base = material.base_color * color * texels.of[base_color_texture];
    const vec4 surface = texels.of[metallic_roughness_texture];
    const vec3 outward = dot(normal, normal) > 0.0 ? normalize(normal) : face_normal(position, front_facing);
    const vec3 facing = mapped_normal(draw, material, outward, tangent, texels.of[normal_texture].xyz);
    MaterialPoint m;
    m.position = position;
    m.normal = front_facing ? facing : -facing;
    if (material.lighting_model == model_hair) m.normal = fibre(m.normal, tangent);
    m.base_color = base.rgb;
    m.alpha = base.a;
    m.metallic = has_metals(material.lighting_model) ? material.metallic * surface.b : 0.0;
    m.roughness = material.roughness * surface.g;
    m.occlusion = 1.0 + material.occlusion_strength * (texels.of[occlusion_texture].r - 1.0);
    m.emissive = material.emissive * texels.of[emissive_texture].rgb;
    m.transmission = material.transmission;
    m.lighting_model = material.lighting_model;
    m.alpha_mode = material.alpha_mode;
    return m;
}

#endif
