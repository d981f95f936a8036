// The subset of a sample's subsamples that a fragment covers, one subsample after the other; and where their depths lie.
#ifndef PASSES_TRANSPARENCY_STOCHASTIC_SUBSET_GLSL
#define PASSES_TRANSPARENCY_STOCHASTIC_SUBSET_GLSL
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/stochastic/stochastic.shared.h"
#include "passes/transparency/stochastic/subset.shared.h"

layout(push_constant, scalar) uniform Push { StochasticBand band; };

// To be asked although draws are restricted to the rows of the band: see DrawStep::in_rows.
bool in_band(uint row) { return row >= band.first_row && row - band.first_row < band.rows; }

uint first_subsample(uvec2 pixel) {
    return (((pixel.y - band.first_row) * band.width + pixel.x) * band.samples + gl_SampleID) * band.subsamples;
}

// Bits of positive floats are ordered like the floats.
uint depth_bits(Fragment fragment) { return floatBitsToUint(max(fragment.z, 0.0)); }

// Colored glass covers less than its alpha (McGuire and Mara 2016).
float coverage_of(Fragment fragment) {
    const float coverage = dot(1.0 - fragment.t, vec3(1.0 / 3.0));
    return coverage < least_coverage || !is_finite(fragment.z) ? 0.0 : min(coverage, 1.0);
}

float lattice_number(vec3 position, float scale) {
    const uvec3 cell = uvec3(ivec3(floor(position * scale + 0.5)));  // centered on 0: a quad lies within one layer of cells
    return (float(hashed(hashed(band.params.seed), cell) >> 8u) + 0.5) / 16777216.0;
}

// Wyman and McGuire 2017, with an integer hash: two lattices of about a pixel's size, mixed, and the mixture's distribution
// undone.
float hashed_threshold() {
    const DrawRecord d = draws[in_draw];
    const mat3 to_object = transpose(d.normal_to_view);
    const vec3 here = position_here(), position = to_object * (here - d.to_view[3].xyz);
    const vec2 pixel = 2.0 * here.z / (view.ndc_scale * vec2(view.extent));
    const float octave = -log2(max(length(to_object[0]) * pixel.x, length(to_object[1]) * pixel.y));
    const int coarse = int(floor(octave));
    const float l = octave - float(coarse), a = min(l, 1.0 - l);
    const float m = mix(lattice_number(position, ldexp(1.0, coarse)), lattice_number(position, ldexp(1.0, coarse + 1)), l);
    const float rim = 2.0 * a * (1.0 - a);
    float threshold = m < a ? m * m / rim : m < 1.0 - a ? (m - 0.5 * a) / (1.0 - a) : 1.0 - (1.0 - m) * (1.0 - m) / rim;
    if (a <= 0.0) threshold = m;  // 0 / 0
    return clamp(threshold, 1e-6, 1.0);
}

struct Subset {
    uint key;
    uint alpha;
    uint wanted;  // still, of a stratified one
};

Subset subset_of(Fragment fragment, uvec2 pixel) {
    const float coverage = coverage_of(fragment);
    const float alpha = band.params.mode == mode_hashed ? float(coverage > 0.0 && coverage >= hashed_threshold()) : coverage;
    const uint key = fragment_key(band.params.seed, uvec3(pixel, gl_SampleID), in_draw, in_triangle);
    const uint fixed_alpha = uint(alpha * 16777216.0);
    return Subset(key, fixed_alpha, subset_size(key, fixed_alpha, band.subsamples));
}

// To be asked for every subsample in turn.
bool covers(inout Subset subset, uint subsample) {
    if (band.params.subset == subset_bernoulli) return random_24_bits(subset.key, subsample) < subset.alpha;
    const bool is_in = is_selected(subset.key, subsample, subset.wanted, band.subsamples - subsample);
    subset.wanted -= is_in ? 1u : 0u;
    return is_in;
}

#endif
