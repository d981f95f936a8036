// Moves the exposure towards what the mean luminance asks for (docs/algorithms/deferred.md 8.5), by the time that went by.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/exposure/measured.glsl"

layout(local_size_x = 256) in;

layout(constant_id = 1) const uint form = exposure_exponential;

layout(set = 0, binding = 0, r32f) writeonly uniform image2D exposure;
layout(set = 0, binding = 2) uniform sampler2D held;
layout(set = 0, binding = 3, scalar) writeonly buffer State { ExposureState state; };

// The share of the way to the target.
float share_of(vec4 before) {
    if (before.y <= 0.0) return 1.0;
    if (form == exposure_exponential) return 1.0 - exp(-before.y * push.speed);
    return clamp(0.9 * before.z + 0.1 * before.y * push.speed, 0.0, 1.0);
}

void adapt(vec2 sum) {
    const vec4 before = texelFetch(held, ivec2(0), 0);
    const bool goes_on = before.y > 0.0;
    const float share = share_of(before), from = goes_on ? before.x : 1.0;
    float adapted = sum.y > 0.0 ? mix(from, target_of(sum.x / sum.y), share) : from;
    if (isnan(adapted)) adapted = from;
    imageStore(exposure, ivec2(0), vec4(adapted, 0.0, 0.0, 0.0));
    state = ExposureState(adapted, goes_on ? share : 0.0, 1u, push.ticks);
}

void main() {
    const vec2 sum = measured_sum();
    if (gl_LocalInvocationIndex == 0u) adapt(sum);
}
