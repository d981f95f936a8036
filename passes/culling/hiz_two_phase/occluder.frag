// Depth alone. Backs of one-sided faces hide nothing, for the G-buffer does not draw them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"

layout(location = 0) flat in uint in_draw;

void main() {
    if (!gl_FrontFacing && materials[draws[in_draw].material].double_sided == 0u) discard;
}
