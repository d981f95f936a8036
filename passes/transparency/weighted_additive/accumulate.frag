// As published: color and emission in one weighted sum (Kircher, GDC 2018).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/weighted_additive/accumulation.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_sum;
layout(location = 1) out vec4 out_reveal;        // multiplied
layout(location = 2) out vec4 out_additiveness;  // added

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    atomicAdd(counters.fragments, 1u);
    mark_tiles();
    out_sum = vec4(min(fragment.p + fragment.e, largest_color), 1.0) * weight_of(fragment);
    out_reveal = vec4(fragment.t, 1.0);
    out_additiveness = additiveness_of(fragment);
}
