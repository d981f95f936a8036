// T(z) from the moments of the texel under the fragment (Muenstermann et al. 2018; docs/algorithms/transparency.md 4.5 to 4.8).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/moments/moments.shared.h"
#include "passes/transparency/functions/outputs.glsl"
#include "passes/transparency/low_resolution/filtered.glsl"

layout(push_constant, scalar) uniform Push { MomentsPush push; };
#include "passes/transparency/moments/quantization.glsl"
#include "passes/transparency/moments/trigonometric.glsl"

layout(early_fragment_tests) in;
layout(constant_id = 11) const uint storage = storage_single;
layout(set = 0, binding = 1) uniform sampler2DArray total;
layout(set = 0, binding = 2) uniform sampler2DArray head;
layout(set = 0, binding = 3) uniform sampler2DArray tail;
layout(set = 0, binding = 20, scalar) buffer Counters { MomentsCounters counters; };

// Even power moments of what a degenerate matrix is mixed with; odd ones are 0 (docs/algorithms/transparency.md 4.4).
float bias_moment(uint i) {
    if (i % 2u == 0u) return 0.0;
    const bool fine = storage != storage_normalized;
    if (roots == 2u) return fine ? 0.375 : 0.628;
    if (roots == 3u) return fine ? vec3(0.48, 0.451, 0.45)[i / 2u] : vec3(0.5566, 0.489, 0.47869382)[i / 2u];
    return fine ? vec4(0.75, 0.67666667, 0.63, 0.6003030303)[i / 2u]
                : vec4(0.4247491639, 0.2240780268, 0.1536923077, 0.1290044053)[i / 2u];
}

// Stored numbers become normalized, biased moments.
void decode(vec4 first, vec4 second, float sum, out float moments[8]) {
    for (uint i = 0u; i < 4u; ++i) {
        moments[i] = first[i];
        moments[i + 4u] = second[i];
    }
    if (storage == storage_normalized) dequantize(moments);
    else for (uint i = 0u; i < 8u; ++i) moments[i] /= sum;
    for (uint i = 0u; i < 8u; ++i)
        moments[i] = mix(moments[i], trigonometric ? 0.0 : bias_moment(i), push.bias);
}

float absorbance(float moments[8], float z) {
    if (trigonometric) {
        vec2 b[5];
        b[0] = vec2(1.0, 0.0);
        for (uint i = 0u; i < 4u; ++i) b[i + 1u] = vec2(moments[2u * i], moments[2u * i + 1u]);
        return circle_absorbance_before(b, phase(warped(z)), push.overestimation);
    }
    float b[9];
    b[0] = 1.0;
    for (uint i = 0u; i < 8u; ++i) b[i + 1u] = moments[i];
    return absorbance_before(b, warped(z), push.overestimation);
}

float transmittance(uint channel, float z, float own_depth) {
    const vec3 at = vec3(drawn_place(), float(channel));
    const float sum = filtered(total, at).r;
    if (sum < least_moment_depth) return 1.0;
    float moments[8];
    decode(filtered(head, at), filtered(tail, at), sum, moments);
    const float own = push.compensation == compensation_own ? push.overestimation * own_depth : 0.0;
    const float through = exp(min(own - sum * absorbance(moments, z), 0.0));
    if (is_finite(through)) return through;
    atomicAdd(counters.repaired, 1u);
    return exp(-0.5 * sum);
}

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    vec3 through = vec3(0.0);
    for (uint channel = 0u; channel < push.channels; ++channel)
        through[channel] = transmittance(channel, fragment.z, moment_depth(fragment.t, push.channels == 1u ? 3u : channel));
    if (push.channels == 1u) through = through.rrr;
    atomicAdd(counters.function.drawn, 1u);
    if (is_clamped(fragment)) atomicAdd(counters.function.clamped, 1u);
    write_fragment(fragment, through);
}
