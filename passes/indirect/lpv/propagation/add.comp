// Light of a further bounce added to what cells held of those before it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/grid.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) readonly buffer More { LightCell more[]; };
layout(set = 0, binding = 1, scalar) buffer Total { LightCell total[]; };

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (!in_grid(grid, at)) return;
    const uint cell = cell_index(grid, at);
    total[cell].red += more[cell].red;
    total[cell].green += more[cell].green;
    total[cell].blue += more[cell].blue;
}
