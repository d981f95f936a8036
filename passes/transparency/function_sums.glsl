// The sums of function_draw.h as the steps after the draw read them.
#ifndef PASSES_TRANSPARENCY_FUNCTION_SUMS_GLSL
#define PASSES_TRANSPARENCY_FUNCTION_SUMS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/function.shared.h"
#include "passes/transparency/optical_depth.glsl"
#include "passes/transparency/sanitize.glsl"

layout(constant_id = 0) const uint chromatic = 0u;  // 1: extinction and normalizer have three channels
layout(constant_id = 1) const uint emits = 0u;      // 1: there is emission
layout(set = 0, binding = 1) uniform sampler2DArray color_sum;
layout(set = 0, binding = 2) uniform sampler2DArray extinction;
layout(set = 0, binding = 3) uniform sampler2DArray normalizer;
layout(set = 0, binding = 4) uniform sampler2DArray emission;

vec3 channels(vec4 texel) { return chromatic != 0u ? texel.rgb : texel.rrr; }

// (1 - exp(-X)) / N; 1 where nothing covers.
float factor(float x, float n) { return n > least_normalizer ? opacity(x) / n : 1.0; }
vec3 factor(vec3 x, vec3 n) { return vec3(factor(x.r, n.r), factor(x.g, n.g), factor(x.b, n.b)); }

#endif
