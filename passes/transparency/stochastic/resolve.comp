// The mean of the subsamples over what shows through (Enderton et al. 2010; docs/algorithms/transparency.md 2.6).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/sanitize.glsl"
#include "passes/transparency/stochastic/stochastic.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint chromatic = 0u;  // 1: reveal has three channels
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1, scalar) readonly buffer Depths { uint depths[]; };
layout(set = 0, binding = 2) uniform sampler2DArray sum;
layout(set = 0, binding = 3) uniform sampler2DArray emitted;
layout(set = 0, binding = 4) uniform sampler2DArray reveal;
layout(push_constant, scalar) uniform Push { StochasticBand band; };


float uncovered(uvec3 at) {
    const uint first = ((at.y * band.width + at.x) * band.samples + at.z) * band.subsamples;
    uint count = 0u;
    for (uint s = 0u; s < band.subsamples; ++s) count += depths[first + s] == uncovered_depth ? 1u : 0u;
    return float(count) / float(band.subsamples);
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const ivec3 texel = ivec3(at.x, at.y + band.first_row, at.z);
    // A sample that chance left uncovered has no color to correct: dimming what is behind it would leave a dark speck. Hashed
    // alpha is meant to be all or nothing.
    const vec4 total = min(texelFetch(sum, texel, 0), largest_half);
    const bool corrects = band.params.correction == correction_alpha && band.params.mode != mode_hashed && total.a > 0.0;
    const vec3 revealed = texelFetch(reveal, texel, 0).rgb;
    const vec3 through = !corrects ? vec3(uncovered(at)) : chromatic != 0u ? revealed : revealed.rrr;
    // Weights beyond what is covered are fragments at one depth, and share it. An uncorrected T(z) stays as estimated.
    const bool normalizes = corrects || band.params.mode != mode_depth_based;
    const vec3 share = normalizes ? (1.0 - through) / max(total.a, 1e-7) : vec3(1.0);
    const vec4 behind = imageLoad(color, texel);
    const vec3 light = total.rgb * share + min(texelFetch(emitted, texel, 0).rgb, largest_half);
    imageStore(color, texel, vec4(light + behind.rgb * through, behind.a));
}
