// One row of numbers: the mean luminance measured, the exposure it asks for, the frame's exposure, and that of the frame before (0:
// there was none).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/exposure/measured.glsl"

layout(local_size_x = 256) in;

layout(set = 0, binding = 0, rgba32f) writeonly uniform image2D numbers;
layout(set = 0, binding = 2) uniform sampler2D held;
layout(set = 0, binding = 3) uniform sampler2D exposure;

void main() {
    const vec2 sum = measured_sum();
    if (gl_LocalInvocationIndex != 0u) return;
    const float luminance = sum.y > 0.0 ? sum.x / sum.y : 0.0, adapted = texelFetch(exposure, ivec2(0), 0).r;
    const vec4 before = texelFetch(held, ivec2(0), 0);
    imageStore(numbers, ivec2(0), vec4(luminance, target_of(luminance), adapted, before.y > 0.0 ? before.x : 0.0));
}
