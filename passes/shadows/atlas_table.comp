// Rows of the table "atlas": the layer of a map, its upper left texel there and its edge.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"
#include "passes/shadows/shadows.shared.h"

layout(local_size_x = 1, local_size_y = 64) in;
layout(set = 0, binding = 0, rgba32f) writeonly uniform image2DArray numbers;
layout(push_constant, scalar) uniform Atlas { AtlasPush push; };

void main() {
    const uint slot = gl_GlobalInvocationID.y;
    if (slot >= uint(imageSize(numbers).y)) return;
    const float none = uintBitsToFloat(0x7fc00000u);  // makes it no row
    vec4 row = vec4(none);
    if (slot < view.shadow_count) {
        const ShadowRecord map = shadows[push.first + slot];
        row = vec4(map.layer, map.offset, map.size);
    }
    imageStore(numbers, ivec3(0, slot, 0), row);
}
