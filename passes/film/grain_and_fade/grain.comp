// Grain and fading of display light (docs/algorithms/deferred.md 8.9). Noise is a permutation of 4096 values in each tile of 64 x 64
// pixels: every value once, so that its mean is that of the values, exactly.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/film/grain_and_fade/grain_and_fade.shared.h"
#include "passes/shaders/hash.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint form = grain_centered;

layout(set = 0, binding = 0, rgba16f) uniform image2D display;
layout(push_constant, scalar) uniform Push { GrainPush push; };

// A bijection of 12 bits: odd factors, and shifts that are at least half of the bits.
uint permuted(uint value, uint key) {
    uint x = (value + key) & 4095u;
    x ^= x >> 6u;
    x = (x * 2925u + (key >> 12u)) & 4095u;
    x ^= x >> 7u;
    x = (x * 1597u) & 4095u;
    x ^= x >> 6u;
    x = (x * 3413u + (key >> 20u)) & 4095u;
    return x ^ (x >> 7u);
}

// From 0 to 1.
float noise_at(uvec2 pixel) {
    const uvec2 tile = pixel / grain_tile, place = pixel % grain_tile;
    const uint key = hashed(push.key, uvec3(tile, 0u));
    return (float(permuted(place.y * grain_tile + place.x, key)) + 0.5) / float(grain_values);
}

// X-Ray's noise is bytes around 128, which stand for .502: the picture gets brighter by 1.0039.
float neutral_noise(uvec2 pixel) {
    const float noise = noise_at(pixel);
    return form == grain_xray ? (1.0 + floor(255.0 * noise)) / 255.0 : noise;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(display)))) return;
    const vec4 was = imageLoad(display, pixel);
    float factor = 1.0;
    if (form != grain_off) factor = 1.0 + push.amount * (2.0 * neutral_noise(uvec2(pixel)) - 1.0);
    imageStore(display, pixel, vec4(was.rgb * max(factor, 0.0) * (1.0 - push.fade), was.a));
}
