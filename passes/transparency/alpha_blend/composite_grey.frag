// Hands a grey event to the blend unit: dst = (p + e) + t dst, for devices without dual-source blending.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/alpha_blend/alpha_blend.shared.h"
#include "passes/transparency/event.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_added;  // a: t
layout(set = 0, binding = 1, scalar) buffer Counters { AlphaBlendCounters counters; };

void main() {
    const Event event = transparent_event();
    if (!event.visible) discard;
    atomicAdd(counters.fragments, 1u);
    out_added = vec4(event.p + event.e, event.t.g);
}
