// The mean luminance of a frame from what meter.comp measured in its tiles, and the exposure that it asks for
// (docs/algorithms/deferred.md 8.5). For groups of meter_threads.
#ifndef PASSES_LENS_MEASURED_GLSL
#define PASSES_LENS_MEASURED_GLSL
#include "passes/lens/lens.shared.h"

layout(set = 0, binding = 1, scalar) readonly buffer Tiles { MeterRecord tiles[]; };
layout(push_constant, scalar) uniform Push { AdaptPush push; };

shared vec2 sums[meter_threads];

// Luminance and samples of the whole frame in the first invocation, summed in a fixed order.
vec2 measured_sum() {
    const uint i = gl_LocalInvocationIndex;
    vec2 sum = vec2(0.0);
    for (uint tile = i; tile < push.tiles; tile += meter_threads) sum += vec2(tiles[tile].sum, tiles[tile].count);
    sums[i] = sum;
    for (uint half_of = meter_threads / 2u; half_of > 0u; half_of /= 2u) {
        barrier();
        if (i < half_of) sums[i] += sums[i + half_of];
    }
    return sums[0];
}

float target_of(float luminance) {
    const vec3 m = mix(vec3(1.0, 0.0, 1.0), vec3(push.gray, 1.0, exposure_low), push.amount);
    return clamp(m.x / (luminance * m.y + m.z), least_exposure, most_exposure);
}

#endif
