// Visibility of every pixel from that of one of 2 x 2: the four around, bilinear, by how well their surfaces fit; where none does, the one
// that is nearest to the tangent plane.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/occlusion/ssao/places.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray visibility;
layout(set = 0, binding = 1, r16f) writeonly uniform image2DArray occlusion;
layout(set = 0, binding = 2, scalar) buffer Counters { SsaoCounters counters; };

const float least_fit = 1e-3;
const float farthest = 1e30;

float off_plane(Place center, Place other) {
    return other.exists ? abs(dot(other.position - center.position, center.normal)) : farthest;
}

float upsampled(ivec2 pixel, Place center) {
    const ivec2 low = pixel / 2, odd = pixel % 2, last = textureSize(visibility, 0).xy - 1;
    float missing = 0.0, weights = 0.0, nearest = farthest, missing_of_nearest = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        const ivec2 corner = ivec2(i & 1u, i >> 1u);
        const ivec2 texel = min(low + corner, last);
        const vec2 near = mix(1.0 - vec2(corner), vec2(0.5), equal(odd, ivec2(1)));
        const Place place = place_at(ivec3(2 * texel, 0));
        const float weight = near.x * near.y * fit(center, place), off = off_plane(center, place);
        const float here = 1.0 - texelFetch(visibility, ivec3(texel, 0), 0).r;
        missing += weight * here;
        weights += weight;
        if (near.x * near.y > 0.0 && off < nearest) {
            nearest = off;
            missing_of_nearest = here;
        }
    }
    if (weights >= least_fit) return 1.0 - missing / weights;
    atomicAdd(counters.unfit, 1u);
    return 1.0 - missing_of_nearest;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(occlusion))) || at.z > 0 && is_plain(at.xy)) return;
    const Place place = place_at(at);
    const vec4 result = vec4(place.exists ? stored(upsampled(at.xy, place), place) : 1.0);
    imageStore(occlusion, at, result);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(occlusion).z; ++i) imageStore(occlusion, ivec3(at.xy, i), result);
}
