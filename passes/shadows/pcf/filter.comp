// Percentage-closer filtering (Reeves, Salesin, Cook 1987) of every shadowed light at every sample: N x N texels with the
// weights of (N-1)^2 bilinear taps, as integers of 1/256, so that all lit is exactly 1 on every device.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/shaders/camera.glsl"
#include "passes/shadows/pcf/pcf.shared.h"
#include "passes/gbuffer/surface.glsl"
#include "passes/gbuffer/decoders.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int taps = 4;
layout(constant_id = 1) const uint gbuffer_layout = 0u;
layout(constant_id = 2) const uint has_gbuffer2 = 0u;

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1) uniform sampler2DArray depth_layers;
layout(set = 0, binding = 2) uniform sampler2DArray gbuffer0;
layout(set = 0, binding = 3) uniform sampler2DArray gbuffer1;
layout(set = 0, binding = 4) uniform sampler2DArray gbuffer2;
layout(set = 0, binding = 5, r16f) writeonly uniform image2DArray visibility;
layout(set = 0, binding = 6, scalar) buffer Counters { PcfCounters counters; };
layout(push_constant, scalar) uniform Params { PcfParams params; };

const uint light_directional = 7u;  // LightType of capture_format/frame.h
// Share of a cascade's depth that blends into the next (lighting chapter 6.4).
const float blend_share = 0.1;

// Depth is a sample's own, so the ray is too: then position lies on the surface. Standard places (deferred chapter 0.4).
const vec2 places[4] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

vec2 sample_position(uint i) { return view.samples == 1u ? vec2(0.5) : places[i]; }

// Outside the map and where nothing was drawn depth is 0: lit.
uint lit(ivec2 texel, uint slot, float depth) {
    const int size = int(shadows[slot].size);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(size)))) return 1u;
    return depth >= texelFetch(shadow_maps, ivec3(texel, slot), 0).r ? 1u : 0u;
}

uint weight(int tap, uint f) { return tap == 0 ? 256u - f : tap == taps - 1 ? f : 256u; }

// u is in texels, centers at +.5.
float pcf(vec2 u, uint slot, float depth) {
    const vec2 corner = floor(u - 0.5);
    const uvec2 f = min(uvec2(256.0 * (u - 0.5 - corner)), uvec2(255u));
    const ivec2 first = ivec2(corner) - (taps / 2 - 1);
    uint sum = 0u;
    for (int y = 0; y < taps; ++y) {
        uint in_row = 0u;
        for (int x = 0; x < taps; ++x) in_row += weight(x, f.x) * lit(first + ivec2(x, y), slot, depth);
        sum += weight(y, f.y) * in_row;
    }
    const uint total = uint((taps - 1) * (taps - 1)) * 65536u;
    return sum == total ? 1.0 : float(sum) * (1.0 / float(total));
}

// Metres towards the light that keep a plane from shading itself: the kernel's corner and half a texel, times what the plane
// gains on the light per texel.
float bias(ShadowRecord map, float w, vec3 normal, vec3 to_light) {
    const float cosine = clamp(dot(normal, to_light), 1e-3, 1.0);
    const float slope = min(sqrt(1.0 - cosine * cosine) / cosine, params.slope_limit);
    const float radius = 0.70710678 * float(taps) + 0.5;
    return map.bias + radius * map.texel * w * slope;
}

float filtered(uint slot, vec3 position, vec3 normal) {
    const ShadowRecord map = shadows[slot];
    const LightRecord light = lights[map.light];
    const bool sun = light.type == light_directional;
    const vec3 offset = light.position - position;
    const vec3 to_light = sun ? -light.direction : normalize(offset);
    const float w = (map.view_to_map * vec4(position, 1.0)).w;
    float towards = bias(map, w, normal, to_light);
    if (!sun) towards = min(towards, 0.5 * length(offset));
    const vec4 at = map.view_to_map * vec4(position + towards * to_light, 1.0);
    if (at.w <= 0.0) return 1.0;
    const vec2 u = at.xy / at.w * float(map.size);
    if (any(lessThan(u, vec2(-taps))) || any(greaterThan(u, vec2(map.size + taps)))) return 1.0;
    return pcf(u, slot, at.z / at.w);
}

// The first slot that reaches the depth, blended into the next one over its last tenth and finally into lit.
float visible_share(LightRecord light, vec3 position, vec3 normal) {
    float first = 1.0, share = 0.0;
    for (uint slot = light.shadow; slot < light.shadow + light.shadow_slots; ++slot) {
        const float rest = shadows[slot].range_end - position.z;
        if (rest <= 0.0) continue;
        const float here = filtered(slot, position, normal);
        if (share > 0.0) return here + share * (first - here);
        first = here;
        share = min(rest / (blend_share * (shadows[slot].range_end - shadows[slot].range_begin)), 1.0);
        if (share == 1.0) return first;
    }
    return 1.0 + share * (first - 1.0);
}

void count(uint filtered_here, uint penumbra_here) {
    const uint filtered_sum = subgroupAdd(filtered_here);
    const uint penumbra_sum = subgroupAdd(penumbra_here);
    if (subgroupElect()) {
        if (filtered_sum > 0u) atomicAdd(counters.filtered, filtered_sum);
        if (penumbra_sum > 0u) atomicAdd(counters.penumbra, penumbra_sum);
    }
}

void main() {
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, view.extent))) return;
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    const float depth = texelFetch(depth_layers, at, 0).r;
    vec3 position = vec3(0.0), normal = vec3(0.0);
    if (depth > 0.0) {
        const vec4 g2 = has_gbuffer2 != 0u ? texelFetch(gbuffer2, at, 0) : vec4(0.0);
        const vec2 center = vec2(at.xy) + 0.5;
        normal = decode_gbuffer(gbuffer_layout, texelFetch(gbuffer0, at, 0), texelFetch(gbuffer1, at, 0), g2, center).normal;
        position = view_position(vec2(at.xy) + sample_position(uint(at.z)), view_z(depth));
    }
    uint filtered_here = 0u, penumbra_here = 0u;
    for (uint i = 0u; i < view.light_count; ++i) {
        if (lights[i].visibility_layer == no_index) continue;
        float share = 1.0;
        if (depth > 0.0) {
            share = visible_share(lights[i], position, normal);
            ++filtered_here;
            if (share > 0.0 && share < 1.0) ++penumbra_here;
        }
        imageStore(visibility, ivec3(at.xy, int(lights[i].visibility_layer) + at.z), vec4(share));
    }
    count(filtered_here, penumbra_here);
}
