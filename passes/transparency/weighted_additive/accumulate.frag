// As published: color and emission in one weighted sum (Kircher, GDC 2018).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/weighted_additive/accumulation.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_sum;
layout(location = 1) out vec4 out_reveal;        // multiplied
layout(location = 2) out vec4 out_additiveness;  // added

void main() {
    const Event event = transparent_event();
    if (!event.visible) discard;
    atomicAdd(counters.fragments, 1u);
    mark_tiles();
    out_sum = vec4(min(event.p + event.e, largest_color), 1.0) * weight_of(event);
    out_reveal = vec4(event.t, 1.0);
    out_additiveness = additiveness_of(event);
}
