// The largest sum of l0 that was injected into any cell, in fixed point: half floats are scaled by it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/channels.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) readonly buffer Sums { ivec4 sums[]; };
layout(set = 0, binding = 1, scalar) buffer Brightest { uint brightest; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, at)) return;
    const uint cell = cell_index(grid, at);
    const uint first = channels * cell;  // what is known of sources' facing is no brighter
    const int most = max(sums[first].x, max(sums[first + 1u].x, sums[first + 2u].x));
    if (most > 0) atomicMax(brightest, uint(most));
}
