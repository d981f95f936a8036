// Counts become empty lists, one after the other, with room for what was counted: each cell's start, which is its list's end, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/scan.glsl"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/pixel_lists.glsl"
layout(set = 0, binding = 1, scalar) buffer Ends { uint ends[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 0, scalar) readonly buffer GroupStarts { uint group_starts[]; };

void main() {
    const uint first = first_cell(), end = min(first + cells_per_thread, cells_of_band());
    uint sum = 0u;
    for (uint cell = first; cell < end; ++cell) sum += ends[cell];
    uint start = group_starts[gl_WorkGroupID.x] + scan_group(sum).before;
    for (uint cell = first; cell < end; ++cell) {
        const uint count = ends[cell];
        starts[cell] = start;
        ends[cell] = start;
        start += count;
    }
}
