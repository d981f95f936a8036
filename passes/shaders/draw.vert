// Pulls a vertex of the scene and hands its attributes on in view space. The draw's index is gl_InstanceIndex (firstInstance).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/draw_vertex.glsl"

void main() { hand_on(gl_VertexIndex, gl_InstanceIndex); }
