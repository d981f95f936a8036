// The largest blur that reaches into each tile from anywhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/lens.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D reach;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D spread;
layout(push_constant, scalar) uniform Push { BlurPush push; };

// Pixels from the border of one tile to the next pixel of another.
float gap(ivec2 tiles) {
    const vec2 apart = vec2(max((abs(tiles) - 1) * int(blur_tile) + 1, ivec2(0))) * vec2(notEqual(tiles, ivec2(0)));
    return length(apart);
}

void main() {
    const ivec2 tile = ivec2(gl_GlobalInvocationID.xy), size = textureSize(reach, 0);
    if (any(greaterThanEqual(tile, size))) return;
    const int far = int(push.most) / int(blur_tile) + 2;
    const ivec2 first = max(tile - far, ivec2(0)), last = min(tile + far, size - 1);
    float largest = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const float here = texelFetch(reach, ivec2(x, y), 0).r;
            if (here + 1.0 >= gap(ivec2(x, y) - tile)) largest = max(largest, here);
        }
    imageStore(spread, tile, vec4(largest));
}
