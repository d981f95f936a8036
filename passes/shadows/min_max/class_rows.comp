// Rows of the table of lookups by map: lit, shadowed, expensive, and the percentage that bounds answer of those three.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/shadows/min_max/min_max.shared.h"

layout(local_size_x = 1, local_size_y = 64) in;
layout(set = 0, binding = 0, rgba32f) writeonly uniform image2DArray numbers;
layout(set = 0, binding = 1, scalar) readonly buffer MapClasses { uvec4 map_classes[]; };
layout(push_constant, scalar) uniform Rows { ClassRowsPush push; };

void main() {
    const uint slot = gl_GlobalInvocationID.y;
    if (slot >= push.slots) return;
    const vec3 count = vec3(map_classes[slot].xyz);
    const float all = count.x + count.y + count.z;
    imageStore(numbers, ivec3(0, slot, 0), vec4(count, all > 0.0 ? 100.0 * (count.x + count.y) / all : 0.0));
}
