// Averages lit shares over 5 x 5 texels, by how near in depth their rays end and by how near the shares are. The outer texels count half
// along each axis: every place of the 4 x 4 texels of the jitter's pattern has the same weight, so that the pattern cancels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/sun_shafts/ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 2) const uint steps = 32u;
layout(constant_id = 8) const uint divisor = 1u;  // pixels a side for which one ray was marched

layout(set = 0, binding = 0) uniform sampler2DArray shares;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2DArray blurred;

// The border of a beam between two steps moves a share by a step at most: a neighbor that differs by one counts half, and one on the
// other side of the rim of a beam next to nothing.
float likeness(float own, float other) {
    const float apart = float(steps) * (other - own);
    return 1.0 / (1.0 + apart * apart);
}

float mean_share(ivec3 texel, float z) {
    const ivec2 end = textureSize(shares, 0).xy;
    const float own = texelFetch(shares, texel, 0).r;
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 25; ++i) {
        const ivec2 off = ivec2(i % 5, i / 5) - 2, other = texel.xy + off;
        if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, end))) continue;
        const vec2 near = mix(vec2(1.0), vec2(0.5), equal(abs(off), ivec2(2)));
        const float share = texelFetch(shares, ivec3(other, texel.z), 0).r;
        const float weight = near.x * near.y * fit(z, end_depth(ivec3(other * int(divisor), texel.z))) * likeness(own, share);
        sum += weight * share;
        weights += weight;
    }
    return sum / weights;
}

// Radiance; where one ray stands for 2 x 2 pixels the share, which upsample.comp makes radiance of.
void main() {
    const ivec3 texel = ivec3(gl_GlobalInvocationID), at = ivec3(texel.xy * int(divisor), texel.z);
    if (any(greaterThanEqual(texel, imageSize(blurred))) || at.z > 0 && is_plain(at.xy)) return;
    const ShaftRay ray = ray_to(at);
    const float share = mean_share(texel, ray.z);
    const vec3 whole = divisor > 1u ? vec3(1.0) : scattered(ray.meters) * push.radiance * phase_factor(ray.direction);
    imageStore(blurred, texel, vec4(share * whole, 1.0));
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(blurred).z; ++i) imageStore(blurred, ivec3(texel.xy, i), vec4(share * whole, 1.0));
}
