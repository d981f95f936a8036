// Prefix sum of the groups' totals, in place: one workgroup walks over them 256 at a time, so any number will do.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/scan.glsl"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists/pixel_lists.glsl"
layout(set = 0, binding = 0, scalar) buffer GroupStarts { uint group_starts[]; };

void main() {
    const uint groups = (cells_of_band() + cells_per_group - 1u) / cells_per_group;
    uint before = 0u;
    for (uint first = 0u; first < groups; first += scan_threads) {
        const uint i = first + gl_LocalInvocationIndex;
        const Scanned scanned = scan_group(i < groups ? group_starts[i] : 0u);
        if (i < groups) group_starts[i] = before + scanned.before;
        before += scanned.total;
    }
}
