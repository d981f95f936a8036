// Keeps the K nearest; what falls out is gone.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/k_buffer/keep.glsl"

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    keep(fragment);
}
