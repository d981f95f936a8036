// The radiance before exposure that the glow adds to a pixel.
#ifndef PASSES_LENS_ADDED_GLSL
#define PASSES_LENS_ADDED_GLSL
#include "passes/lens/bloom/doubled.glsl"
#include "passes/lens/lens.shared.h"
#include "passes/shaders/scene.glsl"

layout(constant_id = 1) const uint form = bloom_pyramid;
layout(constant_id = 20) const uint has_exposure = 0u;

layout(set = 0, binding = 1) uniform sampler2D glow;
layout(set = 0, binding = 10) uniform sampler2D exposure;
layout(push_constant, scalar) uniform Push { GlowPush push; };

// Four texels of X-Ray's glow mixed, the border held.
vec4 glow_at(ivec2 pixel, ivec2 extent) {
    const ivec2 last = textureSize(glow, 0) - 1;
    const vec2 at = (vec2(pixel) + 0.5) / vec2(extent) * vec2(last + 1) - 0.5, share = fract(at);
    const ivec2 low = clamp(ivec2(floor(at)), ivec2(0), last), high = clamp(ivec2(floor(at)) + 1, ivec2(0), last);
    const vec4 top = mix(texelFetch(glow, low, 0), texelFetch(glow, ivec2(high.x, low.y), 0), share.x);
    const vec4 bottom = mix(texelFetch(glow, ivec2(low.x, high.y), 0), texelFetch(glow, high, 0), share.x);
    return mix(top, bottom, share.y);
}

vec3 added_glow(ivec2 pixel, ivec2 extent) {
    vec3 added = vec3(0.0);
    if (form == bloom_pyramid) added = doubled(glow, pixel);
    if (form == bloom_xray) added = glow_at(pixel, extent).rgb * glow_at(pixel, extent).a;
    const float scale = view.exposure * (has_exposure != 0u ? texelFetch(exposure, ivec2(0), 0).r : 1.0);
    added *= push.strength / scale;
    return added;
}

#endif
