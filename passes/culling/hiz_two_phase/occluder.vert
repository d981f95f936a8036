// A vertex of an occluder, at the bits that the G-buffer draws it at.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"

layout(location = 0) flat out uint out_draw;

invariant gl_Position;

void main() {
    const vec3 position = (draws[gl_InstanceIndex].to_view * vec4(vertex_positions[gl_VertexIndex], 1.0)).xyz;
    out_draw = gl_InstanceIndex;
    gl_Position = view.projection * vec4(position, 1.0);
}
