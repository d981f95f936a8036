// The weighted average, amplified by how many layers were additive, over what still shows through (Kircher, GDC 2018;
// docs/algorithms/transparency.md 3.2). One workgroup per tile and sample; a tile no fragment touched is left alone.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/low_resolution/bilinear.glsl"
#include "passes/transparency/sanitize.glsl"
#include "passes/transparency/weighted_additive/weighted_additive.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint chromatic = 0u;       // 1: reveal has three channels
layout(constant_id = 1) const uint low_resolution = 0u;  // 1: there are targets at half resolution to merge
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2DArray sum;
layout(set = 0, binding = 2) uniform sampler2DArray reveal;
layout(set = 0, binding = 3) uniform sampler2DArray additiveness;
layout(set = 0, binding = 4) uniform sampler2DArray emitted;
layout(set = 0, binding = 5) uniform sampler2DArray low_sum;
layout(set = 0, binding = 6) uniform sampler2DArray low_reveal;
layout(set = 0, binding = 7) uniform sampler2DArray low_additiveness;
layout(set = 0, binding = 8) uniform sampler2DArray low_emitted;
layout(set = 0, binding = 9, scalar) readonly buffer Written { uint written[]; };
layout(set = 0, binding = 10, scalar) buffer Counters { WeightedAdditiveCounters counters; };
layout(push_constant, scalar) uniform Push { WeightedAdditiveParams params; };

const float overflowed = 100.0;

struct Totals {
    vec4 sum;  // weighted colors, weights
    vec4 emitted;
    vec3 reveal;
    float additiveness;  // layers
};

vec4 bounded(vec4 value) { return clamp(value, -largest_half, largest_half); }

vec3 channels(vec4 revealed) { return chromatic != 0u ? revealed.rgb : revealed.rrr; }

// Product, sum and sum: the two resolutions need no order between them.
Totals totals_at(ivec3 at) {
    Totals t = Totals(bounded(texelFetch(sum, at, 0)), bounded(texelFetch(emitted, at, 0)),
                      channels(texelFetch(reveal, at, 0)), 8.0 * texelFetch(additiveness, at, 0).r);
    if (low_resolution != 0u) {
        const vec2 place = (vec2(at.xy) + 0.5) / vec2(imageSize(color).xy);
        t.sum = bounded(t.sum + bilinear(low_sum, place, 0, largest_half));
        t.emitted = bounded(t.emitted + bilinear(low_emitted, place, 0, largest_half));
        t.reveal *= channels(bilinear(low_reveal, place, 0, largest_half));
        t.additiveness += 8.0 * bilinear(low_additiveness, place, 0, largest_half).r;
    }
    return t;
}

// What the transparent layers send to the eye.
vec3 radiance_of(Totals t) {
    const bool inf = any(greaterThanEqual(max(t.sum.rgb, t.emitted.rgb), vec3(largest_half)));
    const float hidden = dot(1.0 - t.reveal, vec3(1.0 / 3.0)), additive = t.additiveness;
    const vec3 average = t.sum.rgb / max(t.sum.a, 1e-5);
    const float shown = 1.0 - hidden + 0.25 * hidden;  // of additive layers among those that cover
    vec3 light = average * max(additive * shown + min(2.0 * hidden, 1.0), 1.0);
    if (params.normalization == normalization_corrected)
        light = average * (1.0 - t.reveal) + t.emitted.rgb / max(t.emitted.a, 1e-5) * max(additive, 1.0) * shown;
    return inf ? vec3(overflowed) : light;
}

bool is_written(uvec2 tile) {
    const uint index = tile.y * gl_NumWorkGroups.x + tile.x;
    return (written[index / 32u] & (1u << (index % 32u))) != 0u;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (params.tiles == tiles_written && !is_written(gl_WorkGroupID.xy)) {
        if (gl_LocalInvocationIndex == 0u && at.z == 0) atomicAdd(counters.tiles_skipped, 1u);
        return;
    }
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const Totals totals = totals_at(at);
    const vec4 behind = imageLoad(color, at);
    imageStore(color, at, vec4(radiance_of(totals) + behind.rgb * totals.reveal, behind.a));
}
