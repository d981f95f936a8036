// Fragments covering a pixel, of its deepest sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists.shared.h"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/transparency/lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform writeonly image2DArray picture;
layout(set = 0, binding = 1, scalar) readonly buffer Counts { uint counts[]; };

void main() {
    const uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= band.width || at.y >= band.rows) return;
    uint deepest = 0u;
    for (uint s = 0u; s < band.samples; ++s) deepest = max(deepest, counts[cell_of(at, s)]);
    imageStore(picture, ivec3(at, 0), vec4(vec3(float(deepest)), 1.0));
}
