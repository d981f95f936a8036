// Offsets composited over each other as alpha blending composites radiance: dst = d + t dst.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/shaders/luminance.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_offset;  // a: what it lets through

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    out_offset = vec4(fragment.d, 0.0, luminance(fragment.t));
}
