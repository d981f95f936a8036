// L = L_behind exp(-X) + C (1 - exp(-X)) / N + E (transparency chapter 7).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/function_sums.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 5, scalar) buffer Counters { FunctionCounters counters; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const vec3 x = channels(texelFetch(extinction, at, 0)), n = channels(texelFetch(normalizer, at, 0));
    vec3 over = min(texelFetch(color_sum, at, 0).rgb, largest_half) * factor(x, n);
    if (emits != 0u) over += min(texelFetch(emission, at, 0).rgb, largest_half);
    const vec3 clean = finite_or_zero(over);
    if (any(notEqual(clean, over))) atomicAdd(counters.scrubbed, 1u);
    const vec4 behind = imageLoad(color, at);
    imageStore(color, at, vec4(clean + behind.rgb * exp(-x), behind.a));
}
