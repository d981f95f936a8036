// The first K fragments of a sample are stored in their order of arrival; what comes later is merged into one layer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/helper_invocations.glsl"
#include "passes/transparency/a_buffer/a_buffer.shared.h"
#include "passes/transparency/a_buffer/counts.glsl"
#include "passes/transparency/a_buffer/rounding.glsl"
#include "passes/transparency/fragment.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_sum;      // of p + e, and of coverage
layout(location = 1) out vec4 out_through;  // multiplied
layout(push_constant, scalar) uniform Push { ABufferPush params; };
// Layer = slot * samples + sample.
layout(set = 0, binding = 1) uniform writeonly image2DArray colors;
layout(set = 0, binding = 2) uniform writeonly image2DArray transmittances;
layout(set = 0, binding = 3) uniform writeonly image2DArray depths;
layout(set = 0, binding = 4, scalar) buffer Counts { uint counts[]; };
layout(set = 0, binding = 5, scalar) buffer Counters { ABufferCounters counters; };

// A swap fails where another one has raised one of the word's four counts, which end at most_counted.
const uint most_swaps = 4u * most_counted + 1u;

// How many came before; 255 are as good as more.
uint arrival(ivec3 texel) {
    if (is_helper()) return most_counted;
    const CountPlace place = count_place(texel);
    uint seen = counts[place.word], expected = ~seen, swaps = 0u;
    for (; swaps < most_swaps && seen != expected && count_in(seen, place) < most_counted; ++swaps) {
        expected = seen;
        seen = atomicCompSwap(counts[place.word], expected, expected + (1u << place.shift));
    }
    atomicAdd(counters.atomics, swaps);
    if (seen != expected && count_in(seen, place) < most_counted) atomicAdd(counters.unfinished, 1u);
    return count_in(seen, place);
}

void store(ivec3 texel, uint slot, Fragment fragment, vec3 through) {
    const ivec3 at = ivec3(texel.xy, slot * view.samples + texel.z);
    const vec3 kept = params.chromatic != 0u ? rounded_r11g11b10(through) : vec3(rounded_unorm8(through.r));
    imageStore(colors, at, vec4(rounded_r11g11b10(fragment.p + fragment.e), 1.0));
    imageStore(transmittances, at, vec4(kept, 1.0));
    imageStore(depths, at, vec4(rounded_half(fragment.z)));
}

void main() {
    const Fragment fragment = transparent_fragment();
    if (!fragment.visible) discard;
    const float coverage = dot(1.0 - fragment.t, vec3(1.0 / 3.0));
    const vec3 through = params.chromatic != 0u ? fragment.t : vec3(1.0 - coverage);
    const ivec3 texel = ivec3(gl_FragCoord.xy, gl_SampleID);
    const uint slot = arrival(texel);
    atomicAdd(counters.fragments, 1u);
    if (slot < params.layers) {
        store(texel, slot, fragment, through);
        discard;
    }
    atomicAdd(counters.overflow, 1u);
    out_sum = vec4(fragment.p + fragment.e, coverage);
    out_through = vec4(through, 1.0);
}
