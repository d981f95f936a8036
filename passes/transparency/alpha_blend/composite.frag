// Hands the fragment to the blend unit: dst = (p + e) + t dst, a transmittance per channel by dual-source blending.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/alpha_blend/alpha_blend.shared.h"
#include "passes/transparency/fragment.glsl"

layout(early_fragment_tests) in;
layout(location = 0, index = 0) out vec4 out_added;
layout(location = 0, index = 1) out vec4 out_through;
layout(set = 0, binding = 1, scalar) buffer Counters { AlphaBlendCounters counters; };

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    atomicAdd(counters.fragments, 1u);
    out_added = vec4(fragment.p + fragment.e, 0.0);
    out_through = vec4(fragment.t, 1.0);
}
