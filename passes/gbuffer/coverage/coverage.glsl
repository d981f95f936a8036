// Which samples of its pixel a masked surface covers (docs/algorithms/deferred.md 4). One invocation decides for all samples of the
// pixel from its center, or, in shaders that run for every sample, for its own.
#ifndef PASSES_GBUFFER_COVERAGE_GLSL
#define PASSES_GBUFFER_COVERAGE_GLSL
#include "passes/gbuffer/coverage/bands.glsl"
#include "passes/shaders/alpha_test.glsl"
#include "passes/shaders/sample_places.glsl"

// 1: the shader runs for every sample, and its varyings are the sample's.
layout(constant_id = 55) const uint masks_at_sample = 0u;

layout(set = 0, binding = 25) uniform sampler2D mask_scales;  // as mask_scale_texel() places them

// A vertex's alpha with its derivatives.
struct VertexAlpha {
    float here, dx, dy;
};

// Exactly 1 where meshes have no colors: an interpolated 1 may be one float less.
VertexAlpha vertex_alpha(float alpha) {
    if (!has_attribute(attribute_color)) return VertexAlpha(1.0, 0.0, 0.0);
    return VertexAlpha(alpha, dFdxFine(alpha), dFdyFine(alpha));
}

// Alpha so many pixels from here, to first order, each tap `scale` pixels wide.
float alpha_beside(MaterialRecord material, Footprint f, VertexAlpha v, vec2 pixels, float scale) {
    const Footprint there = Footprint(f.uv + pixels.x * f.dx + pixels.y * f.dy, scale * f.dx, scale * f.dy);
    return alpha_of(material, there, v.here + pixels.x * v.dx + pixels.y * v.dy);
}

// docs/algorithms/deferred.md 4.1.
uint covered_by_taps(MaterialRecord material, Footprint f, VertexAlpha v, float scale) {
    if (masks_at_sample != 0u) return alpha_beside(material, f, v, vec2(0.0), scale) >= material.mask_cutoff ? every_sample : 0u;
    uint covered = 0u;
    for (uint i = 0u; i < mask_samples; ++i)
        if (alpha_beside(material, f, v, sample_places[i], scale) >= material.mask_cutoff) covered |= 1u << i;
    return covered;
}

// Castano, Computing Alpha Mipmaps, 2010: scales between two mips are mixed as their texels are.
float scaled_alpha(MaterialRecord material, uint number, Footprint f, float alpha) {
    const TextureUseRecord use = material.textures[base_color_texture];
    if (!is_used(base_color_texture) || use.texture == no_index) return alpha;
    const TextureRecord t = textures[use.texture];
    const float lod = min(level_of_detail(t, use, f), float(min(t.mips, mask_scale_mips) - 1u));
    const uint fine = uint(lod), coarse = min(fine + 1u, mask_scale_mips - 1u);
    const float scale = texelFetch(mask_scales, mask_scale_texel(number, fine), 0).r;
    return alpha * mix(scale, texelFetch(mask_scales, mask_scale_texel(number, coarse), 0).r, fract(lod));
}

// Golus, Anti-aliased Alpha Test, 2017. The neighbors' alphas are tapped here: lavapipe 22.3 reads textures as 0 in helper lanes.
float sharpened_alpha(MaterialRecord material, Footprint f, VertexAlpha v, float alpha) {
    const float right = alpha_beside(material, f, v, vec2(1.0, 0.0), 1.0), below = alpha_beside(material, f, v, vec2(0.0, 1.0), 1.0);
    const float change = max(abs(right - alpha) + abs(below - alpha), 1e-4);
    return clamp((alpha - material.mask_cutoff) / change + 0.5, 0.0, 1.0);
}

// Bit i: sample i is covered. `number` is the material's, `surface` tells draw and triangle from others.
uint covered_samples(MaterialRecord material, uint number, vec4 uv, float color_alpha, uint surface) {
    const Footprint f = footprint(uv);
    const VertexAlpha v = vertex_alpha(color_alpha);
    if (masked == masked_per_sample) return covered_by_taps(material, f, v, 1.0);
    if (masked == masked_per_sample_fine) return covered_by_taps(material, f, v, inversesqrt(float(mask_samples)));
    const float alpha = alpha_of(material, f, v.here);
    if (masked == masked_mip_coverage) return scaled_alpha(material, number, f, alpha) >= material.mask_cutoff ? every_sample : 0u;
    if (masked == masked_sharpened) return covered_by_bands(sharpened_alpha(material, f, v, alpha), surface);
    return covered_by_bands(alpha, surface);
}

#endif
