// Corrected: what covers is summed over alpha w, what emits on its own, so that each can be averaged by its own weights.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/weighted_additive/accumulation.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_sum;
layout(location = 1) out vec4 out_reveal;        // multiplied
layout(location = 2) out vec4 out_additiveness;  // added
layout(location = 3) out vec4 out_emitted;

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    atomicAdd(counters.fragments, 1u);
    mark_tiles();
    const float weight = weight_of(fragment);
    out_sum = vec4(min(fragment.p, largest_color), coverage_of(fragment)) * weight;
    out_reveal = vec4(fragment.t, 1.0);
    out_additiveness = additiveness_of(fragment);
    out_emitted = vec4(min(fragment.e, largest_color), fragment.e == vec3(0.0) ? 0.0 : 1.0) * weight;
}
