// The mean of a level of the glow and of all coarser ones, each with the same weight.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/lens/bloom/doubled.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint coarser_levels = 1u;

layout(set = 0, binding = 0) uniform sampler2D coarser;
layout(set = 0, binding = 1) uniform sampler2D level;
layout(set = 0, binding = 2, rgba16f) writeonly uniform image2D mean_level;

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(mean_level)))) return;
    const vec3 own = texelFetch(level, texel, 0).rgb;
    const float share = float(coarser_levels) / float(coarser_levels + 1u);
    imageStore(mean_level, texel, vec4(mix(own, doubled(coarser, texel), share), 1.0));
}
