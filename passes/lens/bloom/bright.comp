// The first level of the glow, at half the extent: what is above the threshold, by tent filters of 1, 3, 3, 1 eighths, so that every
// pixel gives exactly a quarter of itself away and a constant picture stays what it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/bloom/bright.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D level;
layout(push_constant, scalar) uniform Push { BrightPush push; };

vec3 glowing(ivec2 pixel, float scale) {
    const int samples = textureSize(color, 0).z;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < samples; ++i)
        sum += above(bounded(texelFetch(color, ivec3(inside(pixel), i), 0).rgb * scale), push.threshold);
    return sum / float(samples);
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(level)))) return;
    const float weights[4] = float[4](0.125, 0.375, 0.375, 0.125), scale = exposure_scale();
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) sum += weights[x] * weights[y] * glowing(2 * texel + ivec2(x, y) - 1, scale);
    imageStore(level, texel, vec4(sum, 1.0));
}
