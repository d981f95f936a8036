// Keeps where the rain map of one direction lies, as four texels of a row: more directions than one do not fit into push constants.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/rain/wetness/wetness.shared.h"

layout(local_size_x = 1) in;

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D records;
layout(push_constant, scalar) uniform Push { RecordPush push; };

void main() {
    const int row = int(push.place);
    imageStore(records, ivec2(0, row), push.map.u);
    imageStore(records, ivec2(1, row), push.map.v);
    imageStore(records, ivec2(2, row), push.map.depth);
    imageStore(records, ivec2(3, row), vec4(push.map.towards_rain, push.map.texel));
}
