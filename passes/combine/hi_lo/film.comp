// Develops the picture (docs/algorithms/deferred.md 8.1, 3.5): by default every sample is exposed and tone mapped, then the samples
// are averaged. The other order would let one sample of 100 outweigh three of 0.1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/combine/hi_lo/develop.glsl"
#include "passes/shaders/luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const uint resolve = resolve_tone_mapped;
layout(constant_id = 2) const uint has_exposure = 0u;

layout(set = 0, binding = 0) uniform sampler2DArray color;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2D display;
layout(set = 0, binding = 2) uniform sampler2D exposure;  // a factor on the recorded one

vec3 exposed(ivec2 pixel, int i) {
    const vec3 recorded = texelFetch(color, ivec3(pixel, i), 0).rgb * view.exposure;
    return has_exposure != 0u ? recorded * texelFetch(exposure, ivec2(0), 0).r : recorded;
}

// Each sample by 1 / (1 + luminance), so that one of 100 weighs a hundredth of what it adds. Bounded, because an infinite sample
// of no weight would add what is not a number.
vec3 weighted_mean(ivec2 pixel, int samples) {
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < samples; ++i) {
        const vec3 x = clamp(exposed(pixel, i), 0.0, 1e30);
        const float weight = 1.0 / (1.0 + luminance(x));
        sum += x * weight;
        weights += weight;
    }
    return sum / weights;
}

// What a sample adds to the mean.
vec3 share_of(vec3 x) {
    if (resolve == resolve_linear) return x;
    if (resolve == resolve_lo_hi) return nearest_byte(tone_mapped(x));
    return tone_mapped(x);
}

vec3 developed(ivec2 pixel) {
    const int samples = textureSize(color, 0).z;
    if (resolve == resolve_weighted) return tone_mapped(weighted_mean(pixel, samples));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < samples; ++i) sum += share_of(exposed(pixel, i));
    const vec3 mean = sum / float(samples);
    if (resolve == resolve_linear) return tone_mapped(mean);
    if (resolve == resolve_lo_hi) return nearest_byte(mean);
    return mean;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(display)))) return;
    imageStore(display, pixel, vec4(developed(pixel), 1.0));
}
