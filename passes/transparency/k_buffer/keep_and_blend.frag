// Keeps the K nearest; what falls out is blended over the tail at once, in whatever order it comes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/k_buffer/keep.glsl"

layout(location = 0, index = 0) out vec4 out_added;    // the tail's radiance, and 0
layout(location = 0, index = 1) out vec4 out_through;  // multiplies the radiance and the tail's transmittance

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const uint64_t fallen = keep(fragment);
    if (fallen == empty_slot) discard;
    const Layer layer = layer_of(fallen);
    out_added = vec4(layer.color, 0.0);
    out_through = vec4(1.0 - layer.alpha);
}
