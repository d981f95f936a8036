// Shafts of every sample from the lit shares of one of 2 x 2 pixels: the four around, bilinear, by how near in depth their rays end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/sun_shafts/ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray shares;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2DArray shafts;

float upsampled(ivec2 pixel, float z) {
    const ivec2 low = pixel / 2, odd = pixel % 2, last = textureSize(shares, 0).xy - 1;
    float sum = 0.0, weights = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        const ivec2 corner = ivec2(i & 1u, i >> 1u), texel = min(low + corner, last);
        const vec2 near = mix(1.0 - vec2(corner), vec2(0.5), equal(odd, ivec2(1)));
        const float weight = near.x * near.y * fit(z, end_depth(ivec3(2 * texel, 0)));
        sum += weight * texelFetch(shares, ivec3(texel, 0), 0).r;
        weights += weight;
    }
    return sum / weights;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(shafts))) || at.z > 0 && is_plain(at.xy)) return;
    const ShaftRay ray = ray_to(at);
    const vec4 result = vec4(upsampled(at.xy, ray.z) * scattered(ray.meters) * push.radiance * phase_factor(ray.direction), 1.0);
    imageStore(shafts, at, result);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(shafts).z; ++i) imageStore(shafts, ivec3(at.xy, i), result);
}
