// From alpha to a number of samples, and from that to a pattern of them (docs/algorithms/deferred.md 4.2).
#ifndef PASSES_GBUFFER_COVERAGE_BANDS_GLSL
#define PASSES_GBUFFER_COVERAGE_BANDS_GLSL
#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/shaders/hash.shared.h"

layout(constant_id = 54) const uint masked = masked_clip;
layout(constant_id = 56) const uint mask_samples = 1u;  // per pixel: 1 or 4

const uint every_sample = 0xfu;

// Draw and triangle as one number.
uint mask_surface(uint draw, uint triangle) { return hashed(hashed(draw) + triangle); }

uint mask_dither(uvec2 pixel, uint surface) {
    if (masked == masked_a2c_or) return (pixel.x | pixel.y) & 3u;
    return (pixel.x + pixel.y + (masked == masked_unbiased ? surface : 0u)) & 3u;
}

// Bands are compared as multiples of their width, in units in which alphas of k / 16 and the dither are exact floats.
uint band_of(float alpha, uint dither) {
    const float samples = float(mask_samples), p = float(dither);
    float position = (samples + 1.0) * alpha, width = 1.0;
    if (masked == masked_a2c_2 || masked == masked_a2c_or) {
        position = 12.0 * (samples + 1.0) * alpha - p;
        width = 12.0;
    } else if (masked == masked_full_step) {
        position = 4.0 * (samples + 1.0) * alpha + p - 1.5;
        width = 4.0;
    } else if (masked == masked_unbiased) {
        position = 4.0 * samples * alpha + p + 0.5;
        width = 4.0;
    }
    uint band = 0u;
    for (uint i = 1u; i <= mask_samples; ++i)
        if (position >= float(i) * width) band = i;
    return band;
}

// Mode 1: single samples in turn, the two diagonals, all but one in turn.
uint turning_pattern(uint count, uint p) {
    if (count == 1u) return 1u << p;
    if (count == 2u) return (p & 1u) == 0u ? 0x9u : 0x6u;
    return count == 3u ? every_sample ^ 1u << p : count == 0u ? 0u : every_sample;
}

// The first `count` samples, turned around by a hash of surface and pixel: layers over each other then hide as much as they should.
uint hashed_pattern(uint count, uvec2 pixel, uint surface) {
    const uint first = (1u << count) - 1u;
    const uint turn = hashed(surface + hashed(pixel.x + hashed(pixel.y))) >> 30u;
    return (first << turn | first >> (4u - turn)) & every_sample;
}

uint covered_by_bands(float alpha, uint surface) {
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint dither = mask_dither(pixel, surface), count = band_of(alpha, dither);
    if (mask_samples == 1u) return count == 0u ? 0u : every_sample;
    if (masked == masked_a2c_1 || masked == masked_sharpened) return turning_pattern(count, dither);
    if (masked == masked_unbiased) return hashed_pattern(count, pixel, surface);
    return (1u << count) - 1u;
}

#endif
