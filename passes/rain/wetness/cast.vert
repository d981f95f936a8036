// A caster's vertex in the rain map, as the falling rain sees it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/rain/wetness/wetness.shared.h"
#include "passes/shaders/vertex.glsl"

layout(push_constant, scalar) uniform Push { RainMapPush push; };

layout(location = 0) out vec4 out_uv;  // uv0, uv1
layout(location = 1) out float out_alpha;
layout(location = 2) flat out uint out_draw;

void main() {
    const Vertex v = vertex_of(gl_VertexIndex, gl_InstanceIndex);
    out_uv = vec4(v.uv0, v.uv1);
    out_alpha = v.color.a;
    out_draw = gl_InstanceIndex;
    gl_Position = push.view_to_map * vec4((draws[gl_InstanceIndex].to_view * vec4(v.position, 1.0)).xyz, 1.0);
}
