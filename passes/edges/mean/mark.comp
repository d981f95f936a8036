// A pixel is an edge where the mean of its samples is not sample 0, as X-Ray marks them (docs/algorithms/deferred.md 3.2: never use
// it). `precise`, because the technique is about the last bit of a sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/mark.glsl"
#include "passes/edges/words.glsl"
#include "passes/edges/mean/mean.shared.h"

layout(constant_id = 1) const uint compares = compares_first;

bool mean_differs(vec4 sum, vec4 first) {
    precise const vec4 mean = sum / float(sample_count());
    return any(notEqual(mean, first));
}

bool any_mean_differs(ivec2 pixel) {
    const ivec3 at = ivec3(pixel, 0);
    const vec4 first0 = texelFetch(gbuffer0, at, 0), first1 = texelFetch(gbuffer1, at, 0), first2 = texelFetch(gbuffer2, at, 0),
               first3 = texelFetch(emission, at, 0);
    precise vec4 sum0 = first0, sum1 = first1, sum2 = first2, sum3 = first3;
    for (int i = 1; i < sample_count(); ++i) {
        sum0 += texelFetch(gbuffer0, ivec3(pixel, i), 0);
        sum1 += texelFetch(gbuffer1, ivec3(pixel, i), 0);
        sum2 += texelFetch(gbuffer2, ivec3(pixel, i), 0);
        sum3 += texelFetch(emission, ivec3(pixel, i), 0);
    }
    if (mean_differs(sum0, first0)) return true;
    return compares == compares_all && (mean_differs(sum1, first1) || mean_differs(sum2, first2) || mean_differs(sum3, first3));
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    mark(pixel, any_mean_differs(pixel), covered_samples(pixel));
}
