// A vertex of the scene as draw.vert hands it on: for vertex shaders that say more than that one.
#ifndef PASSES_SHADERS_DRAW_VERTEX_GLSL
#define PASSES_SHADERS_DRAW_VERTEX_GLSL
#include "passes/shaders/scene.glsl"

layout(location = 0) out vec3 out_position;  // view space
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec4 out_uv;        // uv0, uv1
layout(location = 4) out vec4 out_color;
layout(location = 5) out vec4 out_emissive;  // w: depth offset towards the eye
layout(location = 6) flat out uint out_draw;
layout(location = 7) flat out uint out_triangle;  // its number in the draw; 0 unless numbered_draw.vert draws

// The same bits in every pass: depth tests compare with what another shader wrote.
invariant gl_Position;

vec3 view_position(uint vertex, uint draw) { return (draws[draw].to_view * vec4(vertices[vertex].position, 1.0)).xyz; }

void hand_on(uint vertex, uint draw) {
    const Vertex v = vertices[vertex];
    const DrawRecord d = draws[draw];
    out_position = view_position(vertex, draw);
    out_normal = d.normal_to_view * v.normal;
    out_tangent = vec4(mat3(d.to_view) * v.tangent.xyz, v.tangent.w);
    out_uv = vec4(v.uv0, v.uv1);
    out_color = v.color;
    out_emissive = vec4(v.emissive, v.depth_offset);
    out_draw = draw;
    out_triangle = 0u;
    gl_Position = view.projection * vec4(out_position, 1.0);
}

#endif
