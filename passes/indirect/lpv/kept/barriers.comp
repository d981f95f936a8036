// The blockers and portals that the links were found with, for the frame that looks for those that changed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/kept/barriers.glsl"

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) writeonly buffer Barriers { KeptBarrier barriers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < blocker_count + portal_count) barriers[i] = barrier_of(grid, i);
}
