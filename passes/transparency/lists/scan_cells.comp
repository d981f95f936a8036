// Prefix sums of the counts within groups of 1024 cells, and each group's total.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/scan.glsl"
#include "passes/transparency/lists/event_lists.shared.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { Band band; };
layout(set = 0, binding = 0, scalar) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer GroupStarts { uint group_starts[]; };
layout(set = 0, binding = 3, scalar) buffer Counters { ListCounters counters; };

void main() {
    const uint cells = band.width * band.rows * band.samples;
    const uint first = gl_WorkGroupID.x * cells_per_group + gl_LocalInvocationIndex * 4u;
    uint before[4];
    uint sum = 0u;
    for (uint i = 0u; i < 4u; ++i) {
        before[i] = sum;
        if (first + i < cells) sum += counts[first + i];
    }
    const Scanned scanned = scan_group(sum);
    for (uint i = 0u; i < 4u; ++i)
        if (first + i < cells) starts[first + i] = scanned.before + before[i];
    if (gl_LocalInvocationIndex == 0u) {
        group_starts[gl_WorkGroupID.x] = scanned.total;
        atomicAdd(counters.atomics, scanned.total);  // one each counted them
    }
}
