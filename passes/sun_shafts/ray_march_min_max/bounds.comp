// Least and greatest depth of the shadow maps around each block of 4 x 4 texels of a layer (docs/algorithms/deferred.md 5.4).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sun_shafts/march.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const int reach = 1;  // texels around a block that lookups of a place in it may touch

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1, rg32f) writeonly uniform image2DArray bounds;

void main() {
    const ivec3 block = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(block, imageSize(bounds)))) return;
    const ivec2 first = block.xy * int(bounds_block) - reach, last = first + int(bounds_block) - 1 + 2 * reach;
    const ivec2 border = textureSize(shadow_maps, 0).xy - 1;
    vec2 range = vec2(1e30, -1e30);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const float depth = texelFetch(shadow_maps, ivec3(clamp(ivec2(x, y), ivec2(0), border), block.z), 0).r;
            range = vec2(min(range.x, depth), max(range.y, depth));
        }
    imageStore(bounds, block, vec4(range, 0.0, 0.0));
}
