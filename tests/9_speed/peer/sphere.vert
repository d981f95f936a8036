#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/9_speed/peer/scene.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_color;

void main() {
    out_normal = normal;
    out_color = color;
    gl_Position = to_clip * vec4(position, 1.0);
}
