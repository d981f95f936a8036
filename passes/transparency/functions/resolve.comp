// L = L_behind exp(-X) + C (1 - exp(-X)) / N + E, with L_behind seen D away (docs/algorithms/transparency.md 7 and 6.13), and
// what is not L_behind skewed (6.12).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/distortion/bent_background.glsl"
#include "passes/transparency/functions/sums.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 11) uniform sampler2DArray behind;
layout(set = 0, binding = 12, scalar) buffer Counters { FunctionCounters counters; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const vec3 x = extinction_at(at);
    vec3 over = merged(color_sum, low_color_sum, at).rgb * factor_at(at, x);
    if (emits != 0u) over += merged(emission, low_emission, at).rgb;
    if (tint != tint_total) over *= skew_at(at);
    const vec3 clean = finite_or_zero(over);
    if (any(notEqual(clean, over))) atomicAdd(counters.scrubbed, 1u);
    const vec4 here = imageLoad(color, at);
    const vec3 seen = distorts != 0u ? seen_behind(behind, at, merged(offset, low_offset, at).rg) : here.rgb;
    imageStore(color, at, vec4(clean + seen * exp(-x), here.a));
}
