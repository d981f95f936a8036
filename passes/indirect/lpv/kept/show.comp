// Light that is lit in slices is done: surfaces read it from here on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"
#include "passes/indirect/lpv/stored_cells.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) readonly buffer Coming { uint coming[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Shown { uint shown[]; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, at)) return;
    const uint cell = cell_index(grid, at), first = total_word(cell, 0u);
    for (uint i = 0u; i < channels * stored_words(); ++i) shown[first + i] = coming[first + i];
    if (has_halves() && cell == 0u) shown[0] = coming[0];
}
