// The links between all cells of a grid.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/occlusion/face.glsl"
#include "passes/shaders/finished.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(push_constant, scalar) uniform Push { GridPlace grid; };
layout(set = 0, binding = 0, scalar) writeonly buffer Links { float links[]; };  // of cell c along axis a: [3 c + a]
layout(set = 0, binding = 6, scalar) buffer Counters { LpvCounters counters; };

void main() {
    const uint axis = gl_GlobalInvocationID.z % 3u;
    const ivec3 at = ivec3(gl_GlobalInvocationID.xy, gl_GlobalInvocationID.z / 3u);
    if (!in_grid(grid, at)) return;
    const bool has_neighbor = at[axis] + 1 < int(grid.cells[axis]);
    links[3u * cell_index(grid, at) + axis] = has_neighbor ? link(grid, at, axis) : 0.0;
    if (has_neighbor) atomicAdd(counters.faces_rebuilt, 1u);
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
