#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "shade.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

void main() { out_color = shade(); }
