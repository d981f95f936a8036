// The weighted average of the transparent colors over what still shows through.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/scene.glsl"
#include "passes/transparency/low_resolution/bilinear.glsl"
#include "passes/transparency/sanitize.glsl"
#include "passes/transparency/weighted/weights.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint chromatic = 0u;       // 1: reveal has three channels
layout(constant_id = 1) const uint low_resolution = 0u;  // 1: there are targets at half resolution to merge
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2DArray sum;
layout(set = 0, binding = 2) uniform sampler2DArray reveal;
layout(set = 0, binding = 3, scalar) buffer Counters { WeightedCounters counters; };
layout(set = 0, binding = 4) uniform sampler2DArray low_sum;
layout(set = 0, binding = 5) uniform sampler2DArray low_reveal;
layout(push_constant, scalar) uniform Push { WeightedParams params; };

// As many layers of the mean alpha.
float through_layers(float alphas, float layers) {
    return layers > 0.0 ? pow(clamp(1.0 - alphas / layers, 0.0, 1.0), layers) : 1.0;
}

float weight_at(float z) {
    return weight_of(params.weight, z * params.scale, view.near * params.scale, 0.5, vec3(0.5));
}

// Weights fall with depth or not at all, so the scene's nearest and farthest fragment decide whether they are constant over it
// (docs/algorithms/transparency.md 3.1: a public port's were).
bool weights_differ() {
    const float nearest = uintBitsToFloat(~counters.nearest_inverted), farthest = uintBitsToFloat(counters.farthest);
    return params.form == form_normalized && counters.fragments > 0u && weight_at(nearest) > 1.001 * weight_at(farthest);
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    if (at == ivec3(0)) counters.weights_differ = weights_differ() ? 1u : 0u;
    vec4 total = texelFetch(sum, at, 0);
    vec3 revealed = texelFetch(reveal, at, 0).rgb;
    if (low_resolution != 0u) {
        const vec2 place = (vec2(at.xy) + 0.5) / vec2(imageSize(color).xy);
        const vec3 low = bilinear(low_reveal, place, 0, largest_half).rgb;
        total += bilinear(low_sum, place, 0, largest_half);
        revealed = params.form == form_average ? revealed + low : revealed * low;
    }
    total = clamp(total, -largest_half, largest_half);
    vec3 through = chromatic != 0u ? revealed : revealed.rrr;
    if (params.form == form_average) through = vec3(through_layers(total.a, revealed.r));
    const vec4 behind = imageLoad(color, at);
    vec3 over = total.rgb / max(total.a, 1e-5) * (1.0 - through) + behind.rgb * through;
    if (params.form == form_sum) over = total.rgb + behind.rgb * (1.0 - total.a);
    imageStore(color, at, vec4(over, behind.a));
}
