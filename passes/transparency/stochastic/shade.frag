// Second draw: adds each fragment by the share of subsamples that show it. Layered: of those it covers. Depth based: of
// all, times its coverage; the share is an estimate of T(z).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/stochastic/subset.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_sum;      // weighted colors, weights
layout(location = 1) out vec4 out_emitted;  // light that covers nothing
layout(set = 0, binding = 1, scalar) readonly buffer Depths { uint depths[]; };
layout(set = 0, binding = 2, scalar) buffer Counters { StochasticCounters counters; };

// Compilers may round the depth differently in the two draws.
const uint depth_slack = 2u;

void main() {
    const Fragment fragment = transparent_fragment();
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    if (!fragment.visible || !in_band(pixel.y)) discard;
    atomicAdd(counters.fragments, 1u);
    const uint first = first_subsample(pixel), depth = max(depth_bits(fragment), depth_slack) - depth_slack;
    Subset subset = subset_of(fragment, pixel);
    uint shown = 0u, shown_of_covered = 0u;
    for (uint s = 0u; s < band.subsamples; ++s) {
        const bool is_shown = depth <= depths[first + s], is_covered = covers(subset, s);
        shown += is_shown ? 1u : 0u;
        shown_of_covered += is_shown && is_covered ? 1u : 0u;
    }
    const float coverage = coverage_of(fragment), share = float(shown) / float(band.subsamples);
    const bool by_depth = band.params.mode == mode_depth_based;
    const float weight = by_depth ? coverage * share : float(shown_of_covered) / float(band.subsamples);
    const vec3 color = min(fragment.p / max(coverage, least_coverage), largest_half);
    out_sum = vec4(color, 1.0) * weight;
    out_emitted = vec4(fragment.e + (coverage == 0.0 ? fragment.p : vec3(0.0)), 0.0) * share;
}
