// Light that is lit in slices is done: surfaces read it from here on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) readonly buffer Coming { LightCell coming[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Shown { LightCell shown[]; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, at)) return;
    shown[cell_index(grid, at)] = coming[cell_index(grid, at)];
}
