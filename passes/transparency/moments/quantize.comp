// Builds the 16-bit moments of every texel fragment by fragment, in the order of submission, as an ordered interlock would: they
// are stored normalized, so each new one makes the others again, and each is rounded again.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/pixel_lists.shared.h"
#include "passes/transparency/moments/moments.shared.h"

layout(push_constant, scalar) uniform Push {
    Band band;
    MomentsPush push;
};
#include "passes/shaders/finished.glsl"
#include "passes/transparency/lists/fragments.glsl"
#include "passes/transparency/lists/per_iteration.glsl"
#include "passes/transparency/moments/quantization.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 6, r32f) uniform writeonly image2DArray total;
layout(set = 0, binding = 7, rgba16) uniform writeonly image2DArray head;
layout(set = 0, binding = 8, rgba16) uniform writeonly image2DArray tail;
layout(set = 0, binding = 9, scalar) buffer Counters { MomentsCounters counters; };

// What 16 bits keep.
void round_to_16_bits(inout float moments[8]) {
    for (uint i = 0u; i < 8u; ++i) moments[i] = round(clamp(moments[i], 0.0, 1.0) * 65535.0) / 65535.0;
}

void add(ListKey key, uint channel, inout float sum, inout float kept[8]) {
    const float tau = moment_depth(fragments[key.fragment].t, channel);
    if (tau <= 0.0) return;
    float moments[8], before[8] = kept;
    fill_moments(warped(key.z), moments);
    dequantize(before);
    const float share = tau / (sum + tau);
    for (uint m = 0u; m < 8u; ++m) kept[m] = sum > 0.0 ? mix(before[m], moments[m], share) : moments[m];
    quantize(kept);
    round_to_16_bits(kept);
    sum += tau;
}

// The texel's sum of optical depths; its stored moments in `kept`.
float build(uint start, uint count, uint channel, out float kept[8]) {
    float sum = 0.0;
    for (uint i = 0u; i < 8u; ++i) kept[i] = 0.0;
    for (uint i = 0u; i < count; i += per_iteration)
        [[unroll]] for (uint k = 0u; k < per_iteration; ++k)
            if (i + k < count) add(keys[start + i + k], channel, sum, kept);
    return sum;
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const uvec2 texel = uvec2(at.x, at.y + band.first_row);
    const uint cell = cell_of(texel, 0u), start = starts[cell], count = list_count(cell);
    for (uint channel = 0u; channel < push.channels; ++channel) {
        float kept[8];
        const float sum = build(start, count, push.channels == 1u ? 3u : channel, kept);
        imageStore(total, ivec3(texel, channel), vec4(sum));
        imageStore(head, ivec3(texel, channel), vec4(kept[0], kept[1], kept[2], kept[3]));
        if (reals > 4u) imageStore(tail, ivec3(texel, channel), vec4(kept[4], kept[5], kept[6], kept[7]));
    }
    if (!finished(band.width)) atomicAdd(counters.function.lists.unfinished, 1u);
}
