// Materials: textures filtered from the texel buffer in shader code, so that every device filters alike, and evaluated into a
// MaterialPoint from the varyings of draw.vert. Fragment shaders only (derivatives): call before any branch that leaves the quad.
#ifndef PASSES_SHADERS_MATERIAL_GLSL
#define PASSES_SHADERS_MATERIAL_GLSL
#include "passes/shaders/material_point.glsl"
#include "passes/shaders/scene.glsl"
#include "passes/shaders/srgb.glsl"

// What the frame's materials use (passes/texture_uses.h); the rest is compiled away.
layout(constant_id = 20) const uint texture_kinds = 0xffffffffu;
layout(constant_id = 21) const uint texture_formats = 0xffffffffu;
const uint base_color_kind = 1u;
const uint surface_kind = 2u;
const uint normal_kind = 4u;
const uint emissive_kind = 8u;
const uint occlusion_kind = 16u;

// TextureFormat and AddressMode of capture_format/frame.h.
const uint texture_rgba8_unorm = 0u;
const uint texture_rgba8_srgb = 1u;
const uint texture_rgba16f = 2u;
const uint texture_rgba32f = 3u;
const uint address_repeat = 0u;
const uint address_clamp = 1u;

bool has_format(uint format) { return (texture_formats & (1u << format)) != 0u; }

uint words_per_texel(uint format) { return format <= texture_rgba8_srgb ? 1u : format == texture_rgba16f ? 2u : 4u; }

vec4 texel(TextureRecord t, uint index) {
    const uint at = t.first + index * words_per_texel(t.format);
    if (has_format(texture_rgba8_unorm) && t.format == texture_rgba8_unorm) return unpackUnorm4x8(texels[at]);
    if (has_format(texture_rgba8_srgb) && t.format == texture_rgba8_srgb) {
        const vec4 coded = unpackUnorm4x8(texels[at]);
        return vec4(srgb_to_linear(coded.rgb), coded.a);
    }
    if (has_format(texture_rgba16f) && t.format == texture_rgba16f)
        return vec4(unpackHalf2x16(texels[at]), unpackHalf2x16(texels[at + 1u]));
    if (!has_format(texture_rgba32f)) return vec4(0.0);
    return uintBitsToFloat(uvec4(texels[at], texels[at + 1u], texels[at + 2u], texels[at + 3u]));
}

// i modulo n in 0..n-1. GLSL leaves % of negative numbers undefined and allows division 2.5 ULP, hence the corrections.
int modulo(int i, int n) {
    int rest = i - n * int(floor(float(i) / float(n)));
    if (rest < 0) rest += n;
    if (rest >= n) rest -= n;
    return clamp(rest, 0, n - 1);
}

int wrapped(int i, int n, uint address) {
    if (address == address_repeat) return modulo(i, n);
    if (address == address_clamp) return clamp(i, 0, n - 1);
    const int turn = modulo(i, 2 * n);
    return turn < n ? turn : 2 * n - 1 - turn;
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
    const uint x0 = uint(wrapped(low.x, size.x, t.address)), x1 = uint(wrapped(low.x + 1, size.x, t.address));
    const uint y0 = base + uint(wrapped(low.y, size.y, t.address) * size.x);
    const uint y1 = base + uint(wrapped(low.y + 1, size.y, t.address) * size.x);
    vec4 upper = vec4(0.0), lower = vec4(0.0);
    for (uint row = 0u; row < 2u; ++row) {
        const uint y = row == 0u ? y0 : y1;
        upper = lower;
        lower = mix(texel(t, y + x0), texel(t, y + x1), f.x);
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
vec4 texture_at(uint kind, TextureUseRecord use, Footprint f) {
    if ((texture_kinds & kind) == 0u || use.texture == no_index) return vec4(1.0);
    const bool first = use.uv_set == 0u;
    const vec3 uv = vec3(first ? f.uv.xy : f.uv.zw, 1.0);
    const vec2 dx = first ? f.dx.xy : f.dx.zw, dy = first ? f.dy.xy : f.dy.zw;
    const mat2 turn = mat2(use.row0.x, use.row1.x, use.row0.y, use.row1.y);
    const TextureRecord t = textures[use.texture];
    return trilinear(t, vec2(dot(use.row0, uv), dot(use.row1, uv)), level_of_detail(t, turn * dx, turn * dy));
}

// The triangle's own outward normal, for meshes without normals (they are 0 there).
vec3 face_normal(vec3 position, bool front_facing) {
    const vec3 n = normalize(cross(dFdxFine(position), dFdyFine(position)));
    return (dot(n, position) < 0.0) == front_facing ? n : -n;
}

// The bitangent is made in the right-handed object space (glTF 2.0, 3.7.2.1: cross(normal, tangent) * w) and carried to view
// space, where a cross product has the sign of the transform's determinant. The tangent is made perpendicular first.
vec3 mapped_normal(uint draw, MaterialRecord material, vec3 n, vec4 tangent, Footprint uv) {
    if ((texture_kinds & normal_kind) == 0u || material.normal_texture.texture == no_index) return n;
    vec3 local = texture_at(normal_kind, material.normal_texture, uv).xyz * 2.0 - 1.0;
    local.xy *= material.normal_scale;
    const vec3 across = tangent.xyz - n * dot(n, tangent.xyz);
    if (dot(across, across) < 1e-20) return n;
    const vec3 t = normalize(across);
    const float hand = determinant(mat3(draws[draw].to_view)) < 0.0 ? -tangent.w : tangent.w;
    return normalize(t * local.x + cross(n, t) * (hand * local.y) + n * local.z);
}

// The varyings of draw.vert, as they are. A normal of a back face is turned around.
MaterialPoint material_point(uint draw, vec3 position, vec3 normal, vec4 tangent, vec4 varying_uv, vec4 color, bool front_facing) {
    const Footprint uv = footprint(varying_uv);
    const MaterialRecord material = materials[draws[draw].material];
    const vec4 base = material.base_color * color * texture_at(base_color_kind, material.base_color_texture, uv);
    const vec4 surface = texture_at(surface_kind, material.metallic_roughness_texture, uv);
    const vec3 outward = dot(normal, normal) > 0.0 ? normalize(normal) : face_normal(position, front_facing);
    const vec3 facing = mapped_normal(draw, material, outward, tangent, uv);
    MaterialPoint m;
    m.position = position;
    m.normal = front_facing ? facing : -facing;
    m.base_color = base.rgb;
    m.alpha = base.a;
    m.metallic = material.metallic * surface.b;
    m.roughness = material.roughness * surface.g;
    m.occlusion = 1.0 + material.occlusion_strength * (texture_at(occlusion_kind, material.occlusion_texture, uv).r - 1.0);
    m.emissive = material.emissive * texture_at(emissive_kind, material.emissive_texture, uv).rgb;
    m.transmission = material.transmission;
    m.lighting_model = material.lighting_model;
    m.alpha_mode = material.alpha_mode;
    return m;
}

#endif
