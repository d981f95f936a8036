// Adds the glow to every sample of a pixel alike, as radiance before exposure.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/lens/bloom/doubled.glsl"
#include "passes/lens/lens.shared.h"
#include "passes/shaders/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint form = bloom_pyramid;
layout(constant_id = 20) const uint has_exposure = 0u;

layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2D glow;
layout(set = 0, binding = 10) uniform sampler2D exposure;
layout(push_constant, scalar) uniform Push { GlowPush push; };

vec4 glow_at(ivec2 pixel) {
    const ivec2 last = textureSize(glow, 0) - 1;
    const vec2 at = (vec2(pixel) + 0.5) / vec2(imageSize(color).xy) * vec2(last + 1) - 0.5, share = fract(at);
    const ivec2 low = clamp(ivec2(floor(at)), ivec2(0), last), high = clamp(ivec2(floor(at)) + 1, ivec2(0), last);
    const vec4 top = mix(texelFetch(glow, low, 0), texelFetch(glow, ivec2(high.x, low.y), 0), share.x);
    const vec4 bottom = mix(texelFetch(glow, ivec2(low.x, high.y), 0), texelFetch(glow, high, 0), share.x);
    return mix(top, bottom, share.y);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(color).xy))) return;
    vec3 added = vec3(0.0);
    if (form == bloom_pyramid) added = doubled(glow, pixel);
    if (form == bloom_xray) added = glow_at(pixel).rgb * glow_at(pixel).a;
    const float scale = view.exposure * (has_exposure != 0u ? texelFetch(exposure, ivec2(0), 0).r : 1.0);
    added *= push.strength / scale;
    for (int i = 0; i < imageSize(color).z; ++i) {
        const vec4 own = imageLoad(color, ivec3(pixel, i));
        imageStore(color, ivec3(pixel, i), vec4(own.rgb + added, own.a));
    }
}
