// X-Ray's glow before its blur (docs/algorithms/deferred.md 8.6): Hi of 8.1 at 256 x 256, half the sum of four taps, and in a what the
// glow is multiplied by. Both clip at 1, as its 8-bit target does; its steps of 1/255 are not repeated.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/bloom/bright.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D glow;

vec3 hi(ivec2 pixel, float scale) {
    const int samples = textureSize(color, 0).z;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < samples; ++i)
        sum += min(bounded(texelFetch(color, ivec3(inside(pixel), i), 0).rgb * scale) / hi_end, 1.0);
    return sum / float(samples);
}

vec3 tap(vec2 uv, float scale) {
    const vec2 at = uv * vec2(textureSize(color, 0).xy) - 0.5, share = fract(at);
    const ivec2 low = ivec2(floor(at));
    return mix(mix(hi(low, scale), hi(low + ivec2(1, 0), scale), share.x),
               mix(hi(low + ivec2(0, 1), scale), hi(low + 1, scale), share.x), share.y);
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(glow)))) return;
    const float scale = exposure_scale();
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 4u; ++i)
        sum += tap((vec2(texel) + vec2(0.25) + 0.5 * vec2(i & 1u, i >> 1u)) / float(xray_extent), scale);
    const vec3 glowing = min(sum / 2.0, 1.0);
    imageStore(glow, texel, vec4(glowing, clamp(dot(glowing, vec3(1.0)) - xray_threshold, 0.0, 1.0)));
}
