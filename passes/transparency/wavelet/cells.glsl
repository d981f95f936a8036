// Depth on [0, 1] and the Haar basis over N = 2^(rank + 1) cells of it (docs/algorithms/transparency.md 5, variant A). A shader
// that includes this declares `WaveletPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_WAVELET_CELLS_GLSL
#define PASSES_TRANSPARENCY_WAVELET_CELLS_GLSL
#include "passes/transparency/functions/optical_depth.glsl"
#include "passes/transparency/wavelet/wavelet.shared.h"

layout(constant_id = 10) const uint rank = 2u;
layout(constant_id = 11) const uint bounds = bounds_frame;
// Bits of the nearest and of the inverted farthest depth of a texel: floats above 0 are ordered as integers are.
layout(set = 0, binding = 10, scalar) buffer Bounds { uvec2 bits_of_bounds[]; };

const uint cells = 2u << rank;

uint index_of(uvec2 texel) { return texel.y * push.width + texel.x; }

// Low-discrepancy dither on [-.5, .5): fractions of multiples of the plastic number's powers (Roberts 2018), in integers.
float noise(uvec2 texel) { return float((texel.x * 3242174889u + texel.y * 2447445414u) >> 8u) / 16777216.0 - 0.5; }

vec2 log_bounds(uvec2 texel) {
    if (bounds == bounds_frame) return vec2(push.log_nearest, push.log_farthest);
    const uvec2 bits = bits_of_bounds[index_of(texel)];
    return log(vec2(uintBitsToFloat(bits.x), uintBitsToFloat(~bits.y))) + vec2(-bounds_margin, bounds_margin);
}

// In cells: 0 at the nearest depth, N - 1 at the farthest.
float cell_of_depth(float z, uvec2 texel) {
    const vec2 range = log_bounds(texel);
    const float d = clamp((log(z) - range.x) / (range.y - range.x), 0.0, 1.0), c = 2.0 * d - 1.0;
    const float shift = push.jitter * noise(texel) * (1.0 - c * c * c * c * c * c);
    return clamp(d * float(cells - 1u) + shift, 0.0, float(cells - 1u));
}

float root_of_two_to(uint p) { return exp2(0.5 * float(p)); }

float wavelet_depth(vec3 t, uint channel) { return min(channel_depth(t, channel), largest_wavelet_depth); }

#endif
