// Rows of the table of modes: number, features, tiles; from cheap to dear, as they are tried.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lighting/tiled/tiled.shared.h"

layout(local_size_x = 1, local_size_y = 32) in;
layout(set = 0, binding = 0, scalar) readonly buffer Dispatches { ModeDispatch dispatches[]; };
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2DArray numbers;
layout(push_constant, scalar) uniform Push { ModeOrder order; };

void main() {
    const uint row = gl_GlobalInvocationID.y;
    if (row >= order.count) return;
    const uint mode = order.modes[row];
    imageStore(numbers, ivec3(0, row, 0), vec4(mode >> 16, mode & 0xffffu, dispatches[mode >> 16].count, 0.0));
}
