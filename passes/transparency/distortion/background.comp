// The background as the offsets bend it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/distortion/bent_background.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2DArray behind;
layout(set = 0, binding = 2) uniform sampler2DArray offsets;

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const vec2 offset = texelFetch(offsets, at, 0).rg;
    if (offset != vec2(0.0)) imageStore(color, at, vec4(seen_behind(behind, at, offset), imageLoad(color, at).a));
}
