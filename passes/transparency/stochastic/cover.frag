// First draw: the nearest depth of every subsample, by atomicMin and so in any order, and the product of transmittances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/stochastic/subset.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_reveal;  // multiplied
layout(set = 0, binding = 1, scalar) buffer Depths { uint depths[]; };
layout(set = 0, binding = 2, scalar) buffer Counters { StochasticCounters counters; };

void main() {
    const Fragment fragment = transparent_fragment();
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (coverage_of(fragment) == 0.0 || !in_band(pixel.y)) discard;
    out_reveal = vec4(fragment.t, 1.0);
    const uint first = first_subsample(pixel), depth = depth_bits(fragment);
    Subset subset = subset_of(fragment, pixel);
    uint covered = 0u;
    for (uint s = 0u; s < band.subsamples; ++s) {
        if (!covers(subset, s)) continue;
        atomicMin(depths[first + s], depth);
        ++covered;
    }
    atomicAdd(counters.atomics, covered);
}
