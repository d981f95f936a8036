// Radiance of samples, as every effect of the lens reads it.
#ifndef PASSES_LENS_SAMPLES_GLSL
#define PASSES_LENS_SAMPLES_GLSL
#include "passes/lens/lens.shared.h"

// A layer per sample; one that is written lies beside it.
layout(set = 0, binding = 0) uniform sampler2DArray color;

bool is_number(vec3 c) { return !(any(isnan(c)) || any(isinf(c))); }

// From 0 to the largest half float; 0 of what is not a number.
vec3 bounded(vec3 c) { return mix(clamp(c, 0.0, brightest), vec3(0.0), isnan(c)); }

// Four samples of a layer mixed, the border held. at: pixels, centers at .5.
vec3 mixed(vec2 at, int layer) {
    const ivec2 last = textureSize(color, 0).xy - 1;
    const vec2 place = clamp(at, vec2(0.0), vec2(last + 1)) - 0.5, share = fract(place);
    const ivec2 low = clamp(ivec2(floor(place)), ivec2(0), last), high = clamp(ivec2(floor(place)) + 1, ivec2(0), last);
    const vec3 top = mix(bounded(texelFetch(color, ivec3(low, layer), 0).rgb),
                         bounded(texelFetch(color, ivec3(high.x, low.y, layer), 0).rgb), share.x);
    const vec3 bottom = mix(bounded(texelFetch(color, ivec3(low.x, high.y, layer), 0).rgb),
                            bounded(texelFetch(color, ivec3(high, layer), 0).rgb), share.x);
    return mix(top, bottom, share.y);
}

#endif
