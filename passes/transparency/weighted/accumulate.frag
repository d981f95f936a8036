// McGuire and Bavoil 2013: adds weighted colors and coverages, multiplies what is left of the background.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/weighted/weights.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_sum;
layout(location = 1) out vec4 out_reveal;
layout(push_constant, scalar) uniform Push { WeightedParams params; };
layout(set = 0, binding = 1, scalar) buffer Counters { WeightedCounters counters; };

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    atomicAdd(counters.fragments, 1u);
    const uint depth = floatBitsToUint(max(fragment.z, 0.0));
    // Reading first saves the atomics for all but a few fragments.
    if (counters.nearest_inverted < ~depth) atomicMax(counters.nearest_inverted, ~depth);
    if (counters.farthest < depth) atomicMax(counters.farthest, depth);
    // Colored glass covers less than its alpha: alpha (1 - mean k) = mean (1 - t) (McGuire and Mara 2016).
    const float coverage = dot(1.0 - fragment.t, vec3(1.0 / 3.0));
    const vec3 color = fragment.p + fragment.e;
    const bool weighs = params.form == form_normalized;
    const float weight =
        weighs ? weight_of(params.weight, fragment.z * params.scale, view.near * params.scale, coverage, color) : 1.0;
    out_sum = vec4(color, coverage) * weight;
    out_reveal = params.form == form_average ? vec4(1.0) : vec4(fragment.t, 1.0);  // added there: counts layers
}
