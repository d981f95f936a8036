// Hashes of blockers and portals, which the host alone knows bit by bit wherever the eye is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/indirect/lpv/kept/kept.shared.h"

layout(local_size_x = 16) in;

layout(push_constant, scalar) uniform Push { IdentityPush push; };
layout(set = 0, binding = 0, scalar) writeonly buffer Identities { uvec2 identities[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < push.count) identities[push.first + i] = push.of[i];
}
