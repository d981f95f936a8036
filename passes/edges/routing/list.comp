// Appends edge pixels to the list, in any order: every entry is shaded by threads of its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/edges/routing/routing.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, r32ui) writeonly uniform uimage2D edge_list;
layout(set = 0, binding = 1, scalar) buffer Dispatch { EdgeDispatch dispatch; };

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), extent = textureSize(edges, 0).xy;
    const bool is_edge = all(lessThan(pixel, extent)) && !is_plain(pixel);
    const uint here = is_edge ? 1u : 0u, all = subgroupAdd(here), before = subgroupExclusiveAdd(here);
    uint first = 0u;
    if (subgroupElect() && all > 0u) first = atomicAdd(dispatch.count, all);
    const uint entry = subgroupBroadcastFirst(first) + before;
    if (is_edge) imageStore(edge_list, ivec2(entry % uint(extent.x), entry / uint(extent.x)), uvec4(pixel.x | pixel.y << 16));
}
