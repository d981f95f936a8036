// The counts of count.comp as rows of a table: surfaces, pixels, marked pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/edges/views/views.shared.h"

layout(local_size_x = 1, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) readonly buffer Counts { SurfaceCounts counts; };
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D numbers;

void main() {
    const uint row = gl_GlobalInvocationID.y;
    if (gl_GlobalInvocationID.x > 0u || row > most_surfaces) return;
    imageStore(numbers, ivec2(0, row), vec4(row, counts.pixels[row], counts.marked[row], 0.0));
}
