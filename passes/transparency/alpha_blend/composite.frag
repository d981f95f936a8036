// Hands the event to the blend unit: dst = (p + e) + t dst, a transmittance per channel by dual-source blending.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/alpha_blend/alpha_blend.shared.h"
#include "passes/transparency/event.glsl"

layout(early_fragment_tests) in;
layout(location = 0, index = 0) out vec4 out_added;
layout(location = 0, index = 1) out vec4 out_through;
layout(set = 0, binding = 1, scalar) buffer Counters { AlphaBlendCounters counters; };

void main() {
    const Event event = transparent_event();
    if (!event.visible) discard;
    atomicAdd(counters.fragments, 1u);
    out_added = vec4(event.p + event.e, 0.0);
    out_through = vec4(event.t, 1.0);
}
