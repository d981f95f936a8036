// Visibility averaged over the surface around: 5 x 5 texels whose outer rows and columns count half, so that every period of 4 x 4, that
// of the interleaved noise, has the same weight.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/occlusion/ssao/places.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray visibility;
layout(set = 0, binding = 1, r16f) writeonly uniform image2DArray blurred;

float share(int offset) { return abs(offset) == 2 ? 0.5 : 1.0; }

// By what is missing to 1: a mean of ones is exactly 1.
float blurred_at(ivec3 texel, Place center) {
    float missing = 0.0, weights = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            const ivec3 other = texel + ivec3(x, y, 0);
            if (any(lessThan(other.xy, ivec2(0))) || any(greaterThanEqual(other.xy, imageSize(blurred).xy))) continue;
            const Place place = place_at(ivec3(other.xy * int(divisor), other.z));
            const float weight = share(x) * share(y) * (x == 0 && y == 0 ? 1.0 : fit(center, place));
            missing += weight * (1.0 - texelFetch(visibility, other, 0).r);
            weights += weight;
        }
    return 1.0 - missing / weights;
}

void main() {
    const ivec3 texel = ivec3(gl_GlobalInvocationID), at = ivec3(texel.xy * int(divisor), texel.z);
    if (any(greaterThanEqual(texel, imageSize(blurred))) || at.z > 0 && is_plain(at.xy)) return;
    const Place place = place_at(at);
    const vec4 result = vec4(place.exists ? stored(blurred_at(texel, place), place) : 1.0);
    imageStore(blurred, texel, result);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(blurred).z; ++i) imageStore(blurred, ivec3(texel.xy, i), result);
}
