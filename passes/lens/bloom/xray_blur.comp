// X-Ray's 15 taps along an axis: together they weigh 1.4.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/lens.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint along_y = 0u;

layout(set = 0, binding = 0) uniform sampler2D glow;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D blurred;
layout(push_constant, scalar) uniform Push { XrayBlurPush push; };

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy), last = textureSize(glow, 0) - 1;
    if (any(greaterThan(texel, last))) return;
    // No choice between vectors by a constant: lavapipe 22.3 takes the wrong one.
    ivec2 step_of = ivec2(1, 0);
    if (along_y != 0u) step_of = step_of.yx;
    vec4 sum = push.weights[0] * texelFetch(glow, texel, 0);
    for (int i = 1; i < 8; ++i) {
        const vec4 before = texelFetch(glow, clamp(texel - i * step_of, ivec2(0), last), 0);
        sum += push.weights[i] * (before + texelFetch(glow, clamp(texel + i * step_of, ivec2(0), last), 0));
    }
    imageStore(blurred, texel, min(sum, 1.0));
}
