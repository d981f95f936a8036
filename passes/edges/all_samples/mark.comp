// Every pixel is an edge: the baseline that shades each sample alone and can miss nothing (docs/algorithms/deferred.md 3).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/all_samples/all_samples.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, r8ui) writeonly uniform uimage2D edges;
layout(set = 0, binding = 1, scalar) buffer Counters { AllSamplesCounters counters; };

void main() {
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(edges)))) return;
    imageStore(edges, at, uvec4(1u));
    const uint pixels = subgroupAdd(1u);
    if (subgroupElect()) atomicAdd(counters.edge_pixels, pixels);
}
