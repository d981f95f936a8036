// Textures filtered from the texel buffer in shader code, so that every device filters alike. Any shader stage.
#ifndef PASSES_SHADERS_TEXTURE_GLSL
#define PASSES_SHADERS_TEXTURE_GLSL
#include "passes/shaders/scene.glsl"
#include "passes/shaders/srgb.glsl"
#include "passes/shaders/textures.shared.h"

// The formats of the textures that are read (passes/scene/material_uses.h); the rest is compiled away.
layout(constant_id = 21) const uint used_formats = 0xffffffffu;
// Their address modes, as bits 1 << mode of one direction.
layout(constant_id = 23) const uint used_addresses = 0xffffffffu;
// TextureRecord::sampling >> filter_shift of all of them; 0: all are filtered linearly.
layout(constant_id = 27) const uint used_filters = 0xffffffffu;

bool has_format(uint format) { return (used_formats & (1u << format)) != 0u; }

// A constant where all textures have one format.
uint format_of(TextureRecord t) { return bitCount(used_formats) == 1 ? uint(findLSB(used_formats)) : t.format; }

uint words_per_texel(uint format) { return format <= texture_rgba8_srgb ? 1u : format == texture_rgba16f ? 2u : 4u; }

vec4 texel(TextureRecord t, uint index) {
    const uint format = format_of(t), at = t.first + index * words_per_texel(format);
    vec4 value = vec4(0.0);
    if (format <= texture_rgba8_srgb && (has_format(texture_rgba8_unorm) || has_format(texture_rgba8_srgb))) {
        value = unpackUnorm4x8(texels[at]);
        if (has_format(texture_rgba8_srgb) && format == texture_rgba8_srgb) value.rgb = srgb_to_linear(value.rgb);
    } else if (has_format(texture_rgba16f) && format == texture_rgba16f) {
        value = vec4(unpackHalf2x16(texels[at]), unpackHalf2x16(texels[at + 1u]));
    } else if (has_format(texture_rgba32f) && format == texture_rgba32f) {
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

// Texels i of n, inside, each by its own mode. Every second turn of a mirrored texture runs backwards.
ivec4 wrapped(ivec4 i, ivec4 n, uvec4 address) {
    const ivec4 clamped = clamp(i, ivec4(0), n - 1);
    if (used_addresses == 1u << address_clamp) return clamped;
    if (used_addresses == 1u << address_repeat) return modulo(i, n);
    const ivec4 turn = modulo(i, mix(2 * n, n, equal(address, uvec4(address_repeat))));
    return mix(min(turn, 2 * n - 1 - turn), clamped, equal(address, uvec4(address_clamp)));
}

// A mip: the texels before its own, and its size.
struct Mip {
    uint base;
    uvec2 size;
};

Mip coarser(Mip mip) { return Mip(mip.base + mip.size.x * mip.size.y, max(uvec2(1u), mip.size >> 1u)); }

// One mip, bilinear: texel centers at +.5. sRGB decodes before filtering. The nearest texel instead is the one that holds uv.
vec4 in_mip(TextureRecord t, Mip mip, vec2 uv, bool is_nearest) {
    const ivec2 size = ivec2(mip.size);
    const vec2 at = uv * vec2(size) - (is_nearest ? 0.0 : 0.5);
    const vec2 corner = floor(at);
    const vec2 f = is_nearest ? vec2(0.0) : at - corner;
    const ivec2 low = ivec2(corner);
    const uvec2 modes = uvec2(t.sampling & 3u, t.sampling >> 2u & 3u);
    const ivec2 high = is_nearest ? low : low + 1;
    const uvec4 corners = uvec4(wrapped(ivec4(low, high), size.xyxy, modes.xyxy));  // x, y low, x, y high
    vec4 upper = vec4(0.0), lower = vec4(0.0);
    for (uint row = 0u; row < 2u; ++row) {
        const uint first = mip.base + (row == 0u ? corners.y : corners.w) * uint(size.x);
        upper = lower;
        lower = mix(texel(t, first + corners.x), texel(t, first + corners.z), f.x);
    }
    return mix(upper, lower, f.y);
}

vec4 bilinear(TextureRecord t, Mip mip, vec2 uv) { return in_mip(t, mip, uv, false); }

Mip mip_of(TextureRecord t, uint number) {
    Mip mip = Mip(0u, uvec2(t.width, t.height));
    for (uint m = 0u; m < number; ++m) mip = coarser(mip);
    return mip;
}

// Two mips mixed, each read as in_mip() says.
vec4 in_mips(TextureRecord t, vec2 uv, float lod, bool is_nearest) {
    const float finer = floor(lod);
    Mip mip = mip_of(t, uint(finer));
    vec4 fine = vec4(0.0), coarse = vec4(0.0);
    const uint mips = lod == finer ? 1u : 2u;
    for (uint i = 0u; i < mips; ++i) {
        fine = coarse;
        coarse = in_mip(t, mip, uv, is_nearest);
        mip = coarser(mip);
    }
    return mips == 1u ? coarse : mix(fine, coarse, lod - finer);
}

vec4 trilinear(TextureRecord t, vec2 uv, float lod) { return in_mips(t, uv, lod, false); }

// As the texture's filters say. The level of detail may be above the mips there are: what is minified is so with one mip, too.
vec4 filtered(TextureRecord t, vec2 uv, float lod) {
    const float level = min(lod, float(t.mips - 1u));
    if (used_filters == 0u) return trilinear(t, uv, level);
    const uint mips = t.sampling >> mip_shift;
    const bool is_nearest = (t.sampling & (lod > 0.0 ? minifies_nearest : magnifies_nearest)) != 0u;
    return in_mips(t, uv, mips == mip_none ? 0.0 : mips == mip_nearest ? ceil(level - 0.5) : level, is_nearest);
}

#endif
