// The sums of the counts of groups of cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/scan.glsl"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/pixel_lists.glsl"
layout(set = 0, binding = 1, scalar) readonly buffer Ends { uint ends[]; };
layout(set = 0, binding = 0, scalar) writeonly buffer GroupStarts { uint group_starts[]; };
layout(set = 0, binding = 3, scalar) buffer Counters { ListCounters counters; };

void main() {
    const uint first = first_cell(), end = min(first + cells_per_thread, cells_of_band());
    uint sum = 0u;
    for (uint cell = first; cell < end; ++cell) sum += ends[cell];
    const Scanned scanned = scan_group(sum);
    if (gl_LocalInvocationIndex != 0u) return;
    group_starts[gl_WorkGroupID.x] = scanned.total;
    atomicAdd(counters.atomics, scanned.total);  // one each counted them
}
