// Counts the visible fragments of every sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 1, r32ui) uniform uimage2DArray layers;

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    imageAtomicAdd(layers, ivec3(gl_FragCoord.xy, gl_SampleID), 1u);
}
