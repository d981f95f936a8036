// T(z) from the coefficients of the texel under the fragment: the values of two cells, mixed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/low_resolution/filtered.glsl"
#include "passes/transparency/wavelet/wavelet.shared.h"

layout(push_constant, scalar) uniform Push { WaveletPush push; };
#include "passes/transparency/wavelet/cells.glsl"

layout(early_fragment_tests) in;
layout(constant_id = 12) const uint correction = correction_none;
layout(set = 0, binding = 1) uniform sampler2DArray coefficients0;
layout(set = 0, binding = 2) uniform sampler2DArray coefficients1;
layout(set = 0, binding = 3) uniform sampler2DArray coefficients2;
layout(set = 0, binding = 4) uniform sampler2DArray coefficients3;
layout(set = 0, binding = 5) uniform sampler2DArray coefficients4;
layout(set = 0, binding = 6) uniform sampler2DArray coefficients5;
layout(set = 0, binding = 7) uniform sampler2DArray coefficients6;
layout(set = 0, binding = 8) uniform sampler2DArray coefficients7;
layout(set = 0, binding = 20, scalar) buffer Counters { FunctionCounters counters; };

float c[32];

void keep(uint first, vec4 four) {
    for (uint i = 0u; i < 4u; ++i) c[first + i] = four[i];
}

void read_coefficients(vec3 at) {
    keep(0u, filtered(coefficients0, at));
    if (rank >= 2u) keep(4u, filtered(coefficients1, at));
    if (rank >= 3u) {
        keep(8u, filtered(coefficients2, at));
        keep(12u, filtered(coefficients3, at));
    }
    if (rank >= 4u) {
        keep(16u, filtered(coefficients4, at));
        keep(20u, filtered(coefficients5, at));
        keep(24u, filtered(coefficients6, at));
        keep(28u, filtered(coefficients7, at));
    }
}

// Optical depth up to the cell: the wavelets that contain it, by the half of each in which it lies.
float cell_value(uint cell) {
    float value = c[cells - 1u];
    for (uint p = 0u; p <= rank; ++p) {
        const uint half_cells = cells >> (p + 1u), k = cell / (2u * half_cells);
        const float wavelet = root_of_two_to(p) * c[(1u << p) - 1u + k];
        value += (cell / half_cells) % 2u == 0u ? -wavelet : wavelet;
    }
    return value;
}

float transmittance(uint channel, uvec2 texel, float s, float own_depth) {
    // Half-resolution draws lie between the texels, whose coefficients mix where their cells are the same.
    vec2 place = drawn_place();
    if (bounds == bounds_pixel) place = (vec2(texel) + 0.5) / vec2(push.width, push.height);
    read_coefficients(vec3(place, float(channel)));
    const uint cell = uint(s);
    const float share = s - float(cell);
    float depth = mix(cell > 0u ? cell_value(cell - 1u) : 0.0, cell_value(cell), share);
    if (correction == correction_own) depth -= share * (1.0 - share) * own_depth;
    return exp(-max(depth, 0.0));
}

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const uvec2 texel = texel_under(uvec2(push.width, push.height));
    const float s = cell_of_depth(fragment.z, texel);
    vec3 through = vec3(0.0);
    for (uint channel = 0u; channel < push.channels; ++channel)
        through[channel] = transmittance(channel, texel, s, wavelet_depth(fragment.t, push.channels == 1u ? 3u : channel));
    if (push.channels == 1u) through = through.rrr;
    atomicAdd(counters.drawn, 1u);
    if (is_clamped(fragment)) atomicAdd(counters.clamped, 1u);
    write_fragment(fragment, through);
}
