// Puts the fragment before its pixel's list.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "tests/9_speed/peer/scene.glsl"
#include "tests/9_speed/peer/shade.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 0, r32ui) uniform uimage2D heads;
layout(set = 0, binding = 1, scalar) writeonly buffer Nodes { Node list_nodes[]; };
layout(set = 0, binding = 2, scalar) buffer Counters { uint used; uint too_long; };

void main() {
    const uint node = atomicAdd(used, 1u);
    if (node >= nodes) return;
    const vec4 shaded = shade();
    const uint next = imageAtomicExchange(heads, ivec2(gl_FragCoord.xy), node);
    list_nodes[node] = Node(uvec2(packHalf2x16(shaded.rg), packHalf2x16(shaded.ba)), gl_FragCoord.z, next);
}
