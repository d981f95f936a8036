// The depth from which on nothing is seen in a tile of pixels: the farthest of the columns that any of them may read, of all
// channels; a column of which something is always seen is infinitely far (docs/algorithms/transparency.md 6.9). A group per tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/camera.glsl"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/zero_depth/zero_depth.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/slices/depth_curve.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 10) const uint tile_edge = 16u;      // in pixels
layout(constant_id = 11) const float slices_to_zero = 0.0;
layout(constant_id = 12) const float farthest_offset = 0.0;  // the greatest by which a fragment is sorted nearer than it is tested
layout(constant_id = 13) const uint reach = 1u;           // columns beside its own that a pixel may read
layout(constant_id = 14) const uint draws_quads = 1u;
layout(set = 0, binding = 10) uniform usampler2DArray zero_slices;
layout(set = 0, binding = 11, r32f) uniform writeonly image2DArray zero_depth;  // reversed; 0: none
layout(set = 0, binding = 14, scalar) writeonly buffer Quads { ZeroQuad quads[]; };
layout(set = 0, binding = 15, scalar) buffer QuadDraw { ZeroDraw quad_draw; };
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

shared uint farthest;

// The column under a pixel's center.
uvec2 column_under(uvec2 pixel) { return (2u * pixel + 1u) * uvec2(push.width, push.height) / (2u * view.extent); }

// This thread's share of the tile's columns.
uint farthest_here() {
    const uvec2 first_pixel = gl_WorkGroupID.xy * tile_edge, last_pixel = min(first_pixel + tile_edge, view.extent) - 1u;
    const uvec2 first = max(column_under(first_pixel), uvec2(reach)) - reach;
    const uvec2 last = min(column_under(last_pixel) + reach, uvec2(push.width, push.height) - 1u);
    uint slice = 0u;
    for (uint y = first.y + gl_LocalInvocationID.y; y <= last.y; y += gl_WorkGroupSize.y)
        for (uint x = first.x + gl_LocalInvocationID.x; x <= last.x; x += gl_WorkGroupSize.x)
            for (uint channel = 0u; channel < push.channels; ++channel)
                slice = max(slice, texelFetch(zero_slices, ivec3(x, y + channel * push.height, 0), 0).r);
    return slice;
}

float device_depth(uint slice) {
    if (slice == no_overflow) return 0.0;
    const float s = float(virtual_slice(slice)) + slices_to_zero + slice_margin;
    if (s > float(virtual_slices()) - end_margin) return 0.0;  // where fragments behind the volume are, too
    return min(view.near / ((1.0 + depth_margin) * depth_of_slice(max(s, 0.0)) + farthest_offset), 1.0);
}

void main() {
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 tile = gl_WorkGroupID.xy;
    if (thread == 0u) farthest = 0u;
    barrier();
    atomicMax(farthest, farthest_here());
    barrier();
    if (thread != 0u) return;
    const float depth = device_depth(farthest);
    imageStore(zero_depth, ivec3(tile, 0), vec4(depth));
    if (depth > 0.0) atomicAdd(counters.zero_tiles, 1u);
    if (draws_quads == 0u) return;
    if (depth > 0.0) quads[atomicAdd(quad_draw.quads, 1u)] = ZeroQuad(tile, depth);
    if (tile != uvec2(0u)) return;
    quad_draw.index_count = 6u;
    quad_draw.first_index = zero_draw_first_index;
    for (uint i = 0u; i < 6u; ++i) quad_draw.indices[i] = i < 3u ? i : 6u - i;
}
