// A caster's vertex in a shadow map. The map covers the viewport: uv 0..1 of the map is the viewport's corner to corner.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"
#include "passes/shadows/pcf/pcf.shared.h"

layout(push_constant, scalar) uniform Slot { PcfSlot push; };

layout(location = 0) out vec4 out_uv;  // uv0, uv1
layout(location = 1) out float out_alpha;
layout(location = 2) flat out uint out_draw;

void main() {
    const Vertex v = vertices[gl_VertexIndex];
    const vec4 position = draws[gl_InstanceIndex].to_view * vec4(v.position, 1.0);
    const vec4 map = shadows[push.slot].view_to_map * vec4(position.xyz, 1.0);
    out_uv = vec4(v.uv0, v.uv1);
    out_alpha = v.color.a;
    out_draw = gl_InstanceIndex;
    gl_Position = vec4(2.0 * map.xy - map.w, map.zw);
}
