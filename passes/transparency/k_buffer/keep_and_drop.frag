// Keeps the K nearest; what falls out is gone.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/k_buffer/keep.glsl"

void main() {
    const Event event = transparent_event();
    if (!event.visible) discard;
    keep(event);
}
