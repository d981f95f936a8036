// Sorts a sample's stored fragments by insertion and composites them, the merged layer behind them, over what was there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/a_buffer/a_buffer.shared.h"
#include "passes/transparency/a_buffer/counts.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Push { ABufferPush params; };
layout(set = 0, binding = 0, rgba32f) uniform image2DArray color;
layout(set = 0, binding = 1) uniform sampler2DArray colors;
layout(set = 0, binding = 2) uniform sampler2DArray transmittances;
layout(set = 0, binding = 3) uniform sampler2DArray depths;
layout(set = 0, binding = 4) uniform sampler2DArray merged_sum;
layout(set = 0, binding = 5) uniform sampler2DArray merged_through;
layout(set = 0, binding = 6, scalar) readonly buffer Counts { uint counts[]; };

const uint most_layers = 16u;  // of the parameter
uint order[most_layers];

// Half floats that are not negative sort by their bits; of equal ones the later arrival is nearer.
uint key_of(ivec3 at, uint slot) {
    const float depth = texelFetch(depths, ivec3(at.xy, slot * view.samples + at.z), 0).r;
    return packHalf2x16(vec2(depth, 0.0)) << 16 | (0xffffu - slot);
}

void sort_by_insertion(ivec3 at, uint count) {
    for (uint i = 0u; i < count; ++i) {
        const uint key = key_of(at, i);
        uint place = i;
        for (; place > 0u && order[place - 1u] > key; --place) order[place] = order[place - 1u];
        order[place] = key;
    }
}

vec3 transmittance_of(sampler2DArray image, ivec3 at) {
    const vec3 t = texelFetch(image, at, 0).rgb;
    return params.chromatic != 0u ? t : t.rrr;
}

// The mean color of what was merged, by coverage, behind the product of transmittances. What covers nothing just adds.
vec3 merged_over(ivec3 at, vec3 behind) {
    const vec4 sum = texelFetch(merged_sum, at, 0);
    const vec3 through = transmittance_of(merged_through, at);
    const vec3 shown = sum.a > 0.0 ? (1.0 - through) / sum.a : vec3(1.0);
    return sum.rgb * shown + through * behind;
}

void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(color)))) return;
    const CountPlace place = count_place(at);
    const uint count = min(count_in(counts[place.word], place), params.layers);
    sort_by_insertion(at, count);
    vec3 sum = vec3(0.0), through = vec3(1.0);
    for (uint i = 0u; i < count; ++i) {
        const uint slot = 0xffffu - (order[i] & 0xffffu);
        const ivec3 stored = ivec3(at.xy, slot * view.samples + at.z);
        sum += through * texelFetch(colors, stored, 0).rgb;
        through *= transmittance_of(transmittances, stored);
    }
    const vec4 behind = imageLoad(color, at);
    imageStore(color, at, vec4(sum + through * merged_over(at, behind.rgb), behind.a));
}
