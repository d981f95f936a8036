// Zeros where a grid is lit anew: a cleared buffer would cost as much in frames that inject nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/channels.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) writeonly buffer Sums { ivec4 sums[]; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, at)) return;
    const uint cell = cell_index(grid, at);
    for (uint channel = 0u; channel < channels; ++channel) sums[channels * cell + channel] = ivec4(0);
}
