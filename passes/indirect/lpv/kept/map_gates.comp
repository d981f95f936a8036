// How many groups inject a light's maps into a grid: none where the grid is not lit anew.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/indirect/lpv/kept/kept.shared.h"

layout(local_size_x = 16) in;

layout(push_constant, scalar) uniform Push { MapGatesPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Starting { uint starting[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Gates { uvec3 gates[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const MapGate gate = push.of[i];
    const bool is_lit_anew = (starting[starting_word(gate.grid)] >> gate.grid % 32u & 1u) != 0u;
    gates[push.first + i] = is_lit_anew ? uvec3(gate.groups, 1u, 1u) : uvec3(0u);
}
