// Keeps the K nearest; what falls out is summed for an average (hybrid transparency, Maule et al. 2013).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/k_buffer/keep.glsl"

layout(location = 0) out vec4 out_sum;    // of p + e, and of alpha
layout(location = 1) out float out_count;  // of what covers

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const uint64_t fallen = keep(fragment);
    if (fallen == empty_slot) discard;
    const Layer layer = layer_of(fallen);
    out_sum = vec4(layer.color, layer.alpha);
    out_count = layer.alpha > 0.0 ? 1.0 : 0.0;
}
