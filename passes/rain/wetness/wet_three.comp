// Wet surfaces in layouts of three images. No format qualifiers: one shader serves all of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/rain/wetness/wet.glsl"

layout(set = 0, binding = 1) uniform writeonly image2DArray wet0;
layout(set = 0, binding = 2) uniform writeonly image2DArray wet1;
layout(set = 0, binding = 3) uniform writeonly image2DArray wet2;

void store(ivec3 at, GBufferWords words) {
    imageStore(wet0, at, words.g0);
    imageStore(wet1, at, words.g1);
    imageStore(wet2, at, words.g2);
}
