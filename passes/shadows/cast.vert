// A caster's vertex in a shadow map. uv 0..1 of the map is its square of the viewport, corner to corner; what leaves it is
// clipped, so that maps that share a layer stay apart.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/vertex.glsl"
#include "passes/shadows/shadows.shared.h"

layout(push_constant, scalar) uniform Cast { CastPush push; };

out float gl_ClipDistance[4];
layout(location = 0) out vec4 out_uv;  // uv0, uv1
layout(location = 1) out float out_alpha;
layout(location = 2) flat out uint out_draw;
layout(location = 3) flat out uint out_triangle;  // its first vertex

void main() {
    const Vertex v = vertex_of(gl_VertexIndex, gl_InstanceIndex);
    const vec4 position = draws[gl_InstanceIndex].to_view * vec4(v.position, 1.0);
    const ShadowRecord shadow = shadows[push.record];
    const vec4 map = shadow.view_to_map * vec4(position.xyz, 1.0);
    out_uv = vec4(v.uv0, v.uv1);
    out_alpha = v.color.a;
    out_draw = gl_InstanceIndex;
    out_triangle = gl_VertexIndex - draws[gl_InstanceIndex].vertex_offset;
    const float share = float(shadow.size) / float(push.viewport);  // exactly 1 for a map alone in its layer
    const vec2 corner = 2.0 * vec2(shadow.offset) / float(push.viewport) - 1.0;
    gl_Position = vec4(2.0 * share * map.xy + corner * map.w, map.zw);
    const vec4 sides = shadow.size == push.viewport ? vec4(1.0) : vec4(map.xy, map.w - map.xy);
    gl_ClipDistance[0] = sides.x;
    gl_ClipDistance[1] = sides.y;
    gl_ClipDistance[2] = sides.z;
    gl_ClipDistance[3] = sides.w;
}
