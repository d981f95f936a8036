// The sums of draw.h as the steps after the draw read them.
#ifndef PASSES_TRANSPARENCY_FUNCTION_SUMS_GLSL
#define PASSES_TRANSPARENCY_FUNCTION_SUMS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/low_resolution/bilinear.glsl"
#include "passes/transparency/functions/function.shared.h"
#include "passes/transparency/functions/optical_depth.glsl"
#include "passes/transparency/sanitize.glsl"
#include "passes/transparency/functions/tint.glsl"

layout(constant_id = 0) const uint chromatic = 0u;       // 1: extinction and normalizer have three channels
layout(constant_id = 1) const uint emits = 0u;           // 1: there is emission
layout(constant_id = 2) const uint low_resolution = 0u;  // 1: there are sums of half-resolution draws
layout(constant_id = 3) const uint distorts = 0u;        // 1: there are offsets
layout(constant_id = 4) const uint tint = tint_total;    // else the normalizer has four channels: see outputs.glsl
layout(set = 0, binding = 1) uniform sampler2DArray color_sum;
layout(set = 0, binding = 2) uniform sampler2DArray extinction;
layout(set = 0, binding = 3) uniform sampler2DArray normalizer;
layout(set = 0, binding = 4) uniform sampler2DArray emission;
layout(set = 0, binding = 5) uniform sampler2DArray offset;
layout(set = 0, binding = 6) uniform sampler2DArray low_color_sum;
layout(set = 0, binding = 7) uniform sampler2DArray low_extinction;
layout(set = 0, binding = 8) uniform sampler2DArray low_normalizer;
layout(set = 0, binding = 9) uniform sampler2DArray low_emission;
layout(set = 0, binding = 10) uniform sampler2DArray low_offset;

// Sums need no order between the two resolutions.
vec4 merged(sampler2DArray full, sampler2DArray low, ivec3 at) {
    vec4 sum = texelFetch(full, at, 0);
    if (low_resolution != 0u)
        sum += bilinear(low, (vec2(at.xy) + 0.5) / vec2(textureSize(full, 0).xy), 0, largest_half);
    return min(sum, largest_half);
}

vec3 channels(vec4 texel) { return chromatic != 0u ? texel.rgb : texel.rrr; }
vec3 extinction_at(ivec3 at) { return channels(merged(extinction, low_extinction, at)); }

// (1 - exp(-X)) / N; 1 where nothing covers.
float factor(float x, float n) { return n > least_normalizer ? opacity(x) / n : 1.0; }
vec3 factor_at(ivec3 at, vec3 x) {
    const vec4 weights = merged(normalizer, low_normalizer, at);
    if (tint != tint_total) return vec3(factor(weights.y, weights.x));
    const vec3 n = channels(weights);
    return vec3(factor(x.r, n.r), factor(x.g, n.g), factor(x.b, n.b));
}

// What all that is drawn is multiplied by, besides.
vec3 skew_at(ivec3 at) { return skew(merged(normalizer, low_normalizer, at).zw); }

#endif
