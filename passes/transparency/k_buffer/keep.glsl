// Puts the fragment among the K nearest of its sample, in order. Every slot takes the nearer of what it has and what comes
// along, and the farther goes on to the next slot: an atomicMin each, and no lock.
#ifndef PASSES_TRANSPARENCY_K_BUFFER_KEEP_GLSL
#define PASSES_TRANSPARENCY_K_BUFFER_KEEP_GLSL
#extension GL_EXT_shader_atomic_int64 : require
#include "passes/transparency/fragment.glsl"
#include "passes/transparency/k_buffer/k_buffer.shared.h"
#include "passes/transparency/k_buffer/keys.glsl"
#include "passes/transparency/k_buffer/slots.glsl"

layout(early_fragment_tests) in;
layout(push_constant, scalar) uniform Push { KBufferParams params; };
layout(set = 0, binding = 1, scalar) buffer Slots { uint64_t slots[]; };
layout(set = 0, binding = 2, scalar) buffer Counters { KBufferCounters counters; };

// Share of the light behind it that a neutral fragment takes: alpha, where nothing is transmitted, which has more bits than 1 - t.
float hidden_share(Fragment fragment) {
    return fragment.t.r == 1.0 - fragment.alpha ? fragment.alpha : 1.0 - fragment.t.r;
}

// The key that had no place in the end: this fragment's or one it displaced; empty_slot when there was room.
uint64_t keep(Fragment fragment) {
    const ivec3 texel = ivec3(gl_FragCoord.xy, gl_SampleID);
    uint64_t carried = key_of(fragment.z, hidden_share(fragment), fragment.p + fragment.e);
    // What the last slot holds only ever comes nearer: behind an old value of it is behind it.
    const bool behind_all = carried >= slots[slot_index(texel, params.layers - 1u)];
    const uint tried = behind_all ? 0u : params.layers;
    uint steps = 0u;
    for (; steps < tried && carried != empty_slot; ++steps) {
        const uint64_t there = atomicMin(slots[slot_index(texel, steps)], carried);
        carried = there > carried ? there : carried;  // empty is the farthest: nothing is left to carry
    }
    atomicAdd(counters.fragments, 1u);
    atomicAdd(counters.atomics, steps);
    if (carried != empty_slot) atomicAdd(counters.displaced, 1u);
    return carried;
}

#endif
