#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/9_speed/peer/scene.glsl"
#include "tests/9_speed/peer/shade.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

void main() { out_color = shade(); }
