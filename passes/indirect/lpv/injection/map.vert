// A caster's vertex in a reflective shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/shaders/vertex.glsl"

layout(push_constant, scalar) uniform Push { MapPush push; };

layout(location = 0) out vec3 out_position;  // view space
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_uv;        // uv0, uv1
layout(location = 3) out vec4 out_color;
layout(location = 4) flat out uint out_draw;

void main() {
    const Vertex v = vertex_of(gl_VertexIndex, gl_InstanceIndex);
    const DrawRecord d = draws[gl_InstanceIndex];
    out_position = (d.to_view * vec4(v.position, 1.0)).xyz;
    out_normal = d.normal_to_view * v.normal;
    out_uv = vec4(v.uv0, v.uv1);
    out_color = v.color;
    out_draw = gl_InstanceIndex;
    gl_Position = push.to_clip * vec4(out_position, 1.0);
}
