// How many tiles have each spectrum.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/tiled.shared.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint tile_count = 0u;
layout(set = 0, binding = 0, scalar) readonly buffer Records { TileRecord records[]; };
layout(set = 0, binding = 1, scalar) buffer Histogram { uint histogram[]; };
layout(push_constant, scalar) uniform Push { ModeOrder order; };

void main() {
    const uint tile = gl_GlobalInvocationID.x;
    if (tile >= tile_count || (records[tile].counts >> 16 & 255u) == empty_tile_mode) return;
    atomicAdd(histogram[(records[tile].spectrum | order.force) & 0xffffu], 1u);
}
