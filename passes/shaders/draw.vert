// Pulls a vertex of the scene and hands its attributes on in view space. The draw's index is gl_InstanceIndex (firstInstance).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"

layout(location = 0) out vec3 out_position;  // view space
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec4 out_uv;        // uv0, uv1
layout(location = 4) out vec4 out_color;
layout(location = 5) out vec4 out_emissive;  // w: depth offset towards the eye
layout(location = 6) flat out uint out_draw;

// The same bits in every pass: depth tests compare with what another shader wrote.
invariant gl_Position;

void main() {
    const Vertex v = vertices[gl_VertexIndex];
    const DrawRecord d = draws[gl_InstanceIndex];
    const vec4 position = d.to_view * vec4(v.position, 1.0);
    out_position = position.xyz;
    out_normal = d.normal_to_view * v.normal;
    out_tangent = vec4(mat3(d.to_view) * v.tangent.xyz, v.tangent.w);
    out_uv = vec4(v.uv0, v.uv1);
    out_color = v.color;
    out_emissive = vec4(v.emissive, v.depth_offset);
    out_draw = gl_InstanceIndex;
    gl_Position = view.projection * vec4(position.xyz, 1.0);
}
