// Ambient visibility of a pixel, or of one of 2 x 2; per sample where the pixel is an edge. Where no surface is, nothing occludes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/occlusion/ssao/horizon.glsl"
#include "passes/occlusion/ssao/xray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 7) const uint form = form_horizon;

layout(set = 0, binding = 0, r16f) writeonly uniform image2DArray visibility;
layout(set = 0, binding = 1, scalar) buffer Counters { SsaoCounters counters; };

float visibility_of(Place place, ivec3 at) {
    Tally tally = Tally(0u, 0u);
    const Center c = Center(place, normalize(-place.position), vec2(at.xy) + 0.5, at.z, noise_at(uvec2(at.xy) / divisor));
    float visible = 1.0;
    if (form == form_horizon) visible = horizon_visibility(c, tally);
    if (form == form_xray) visible = xray_visibility(c, tally);
    atomicAdd(counters.samples, 1u);
    atomicAdd(counters.taps, tally.taps);
    atomicAdd(counters.out_of_reach, tally.in_reach == 0u ? 1u : 0u);
    return visible;
}

void main() {
    const ivec3 texel = ivec3(gl_GlobalInvocationID), at = ivec3(texel.xy * int(divisor), texel.z);
    if (any(greaterThanEqual(texel, imageSize(visibility))) || at.z > 0 && is_plain(at.xy)) return;
    const Place place = place_at(at);
    const vec4 result = vec4(place.exists ? stored(visibility_of(place, at), place) : 1.0);
    imageStore(visibility, texel, result);
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(visibility).z; ++i) imageStore(visibility, ivec3(texel.xy, i), result);
}
