// Of each 2 x 2 pixels with a surface the nearest one in every second block and the farthest in the others, as on a chessboard: where two
// surfaces meet, a pixel of either finds one of its own among the four blocks around it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/surface_at.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, r8ui) writeonly uniform uimage2D chosen_pixels;

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(block, imageSize(chosen_pixels)))) return;
    const float sign = (block.x + block.y) % 2 == 0 ? 1.0 : -1.0;
    uint chosen = 4u;
    float least = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        const ivec2 pixel = 2 * block + ivec2(i & 1u, i >> 1u);
        if (any(greaterThanEqual(pixel, ivec2(view.extent)))) continue;
        const Surface s = surface_at(ivec3(pixel, 0));
        if (!s.exists || chosen < 4u && sign * s.z >= least) continue;
        chosen = i;
        least = sign * s.z;
    }
    imageStore(chosen_pixels, block, uvec4(chosen));
}
