// Marks the halves of the finest slices that transparent triangles are in: what warp.comp makes the table of
// (docs/algorithms/transparency.md 6.10). A row of groups for each draw, a thread for each of its triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/slices/coverage.glsl"
#include "passes/transparency/voxel/thick_fragments/thickness.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 3, scalar) buffer Halves { uint halves[]; };

uint half_of_depth(float z) { return min(uint(2.0 * finest_slice_of_depth(z)), 2u * push.finest_slices - 1u); }

void mark(uint first, uint last) {
    for (uint i = first / 32u; i <= last / 32u; ++i) {
        const uint bits = bits_between(i, first, last);
        if ((halves[i] & bits) != bits) atomicOr(halves[i], bits);
    }
}

void main() {
    const DrawCommand command = commands[first_command + gl_WorkGroupID.y];
    if (draws[command.first_instance].layer > 0u) return;  // interfaces have slices of their own
    const float half_deep = 0.5 * thickness_of(command.first_instance);
    const Rays image = rays_through(vec2(0.0), vec2(push.width, push.height));
    for (uint i = gl_GlobalInvocationID.x; i < command.index_count / 3u; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
        const Triangle triangle = triangle_of(command, i);
        if (!is_seen(triangle)) continue;
        const vec2 depths = depths_within(triangle, image);
        if (depths.x <= depths.y)
            mark(half_of_depth(depths.x - triangle.depth_offset - half_deep), half_of_depth(depths.y - triangle.depth_offset + half_deep));
    }
}
