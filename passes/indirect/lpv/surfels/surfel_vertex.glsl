// The vertex of a surface seen in parallel along an axis of the world, over a grid and the margin around it.
#ifndef PASSES_INDIRECT_LPV_SURFEL_VERTEX_GLSL
#define PASSES_INDIRECT_LPV_SURFEL_VERTEX_GLSL
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/shaders/vertex.glsl"

layout(push_constant, scalar) uniform Push { SurfelPush push; };

layout(location = 0) out vec3 out_place;   // relative to the eye, along the world's axes
layout(location = 1) out vec3 out_normal;  // along the world's axes
layout(location = 2) out vec4 out_uv;      // uv0, uv1
layout(location = 3) out vec4 out_color;
layout(location = 4) flat out uint out_draw;

void main() {
    const Vertex vertex = vertex_of(gl_VertexIndex, gl_InstanceIndex);
    const DrawRecord d = draws[gl_InstanceIndex];
    out_place = view.to_world * (d.to_view * vec4(vertex.position, 1.0)).xyz;
    out_normal = view.to_world * (d.normal_to_view * vertex.normal);
    out_uv = vec4(vertex.uv0, vertex.uv1);
    out_color = vertex.color;
    out_draw = gl_InstanceIndex;
    const vec3 all = vec3(push.grid.cells + 2u * surfel_margin), at = (out_place - push.grid.origin) / push.grid.cell + float(surfel_margin);
    const uint u = (push.axis + 1u) % 3u, v = (push.axis + 2u) % 3u;
    const vec2 texel = vec2(at[u], at[v]) - vec2(surfel_shift_u, surfel_shift_v) / float(surfels_a_side);
    gl_Position = vec4(texel / vec2(all[u], all[v]) * 2.0 - 1.0, at[push.axis] / all[push.axis], 1.0);
}

#endif
