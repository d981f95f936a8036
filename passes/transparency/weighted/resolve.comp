// The weighted average of the transparent colors over what still shows through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/weighted/weighted.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint chromatic = 0u;  // 1: reveal has three channels
layout(constant_id = 1) const uint form = form_normalized;
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2DArray sum;
layout(set = 0, binding = 2) uniform sampler2DArray reveal;

// Half floats end here: past it hardware adds to infinity and lavapipe stays. Both become the largest half.
const float largest_half = 65504.0;

// As many layers of the mean alpha.
float through_layers(float alphas, float layers) {
    return layers > 0.0 ? pow(clamp(1.0 - alphas / layers, 0.0, 1.0), layers) : 1.0;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const vec4 total = clamp(texelFetch(sum, at, 0), -largest_half, largest_half);
    const vec3 revealed = texelFetch(reveal, at, 0).rgb;
    vec3 through = chromatic != 0u ? revealed : revealed.rrr;
    if (form == form_average) through = vec3(through_layers(total.a, revealed.r));
    const vec4 behind = imageLoad(color, at);
    const vec3 average = total.rgb / max(total.a, 1e-5);
    const vec3 over = form == form_sum ? total.rgb + behind.rgb * (1.0 - total.a) : average * (1.0 - through) + behind.rgb * through;
    imageStore(color, at, vec4(over, behind.a));
}
