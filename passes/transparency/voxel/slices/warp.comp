// The table that packs slices with something in them (docs/algorithms/transparency.md 6.10), at the finest resolution at which
// there are no more than the volume has, or a coarser one that is held (docs/algorithms/transparency.md 6.11). One group; a
// thread for each 32 slices.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };
#include "passes/transparency/voxel/slices/history.glsl"

layout(local_size_x = 256) in;
layout(constant_id = 0) const uint splatting = splatting_linear;
layout(set = 0, binding = 3, scalar) readonly buffer Halves { uint halves[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer DepthWarp {  // as depth_curve.glsl reads it
    WarpHeader warp;
    uint warp_entries[];
};
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

const uint threads = most_virtual_slices / 32u;
shared uint covered[2u * threads];  // halves of slices
shared uint counts[threads];        // of slices used in the words up to each
shared uint kept;                   // halvings

// Every second bit, from the lowest on.
uint even_bits(uint bits) {
    bits &= 0x55555555u;
    bits = (bits | bits >> 1u) & 0x33333333u;
    bits = (bits | bits >> 2u) & 0x0f0f0f0fu;
    bits = (bits | bits >> 4u) & 0x00ff00ffu;
    return (bits | bits >> 8u) & 0x0000ffffu;
}

uint covered_word(int word) { return word >= 0 && word < int(2u * threads) ? covered[word] : 0u; }

// Sixteen slices, of a word of halves: a linear splat reaches half a slice further at both ends.
uint used_half_word(int word) {
    const uint here = covered_word(word);
    uint bits = here | here >> 1u;
    if (splatting == splatting_linear) {
        bits |= here << 1u | covered_word(word - 1) >> 31u;
        bits |= here >> 2u | covered_word(word + 1) << 30u;
    }
    return even_bits(bits);
}

// Of `slices` in all.
uint used_word(uint word, uint slices) {
    if (32u * word >= slices) return 0u;
    return used_half_word(int(2u * word)) | used_half_word(int(2u * word) + 1) << 16u;
}

// Two neighboring halves become one, of a slice twice as thick.
uint coarser_word(uint word) {
    const uint low = covered_word(int(2u * word)), high = covered_word(int(2u * word) + 1);
    return even_bits(low | low >> 1u) | even_bits(high | high >> 1u) << 16u;
}

// Leaves in counts[] how many slices are used up to each thread's word.
void sum_up(uint thread, uint used) {
    counts[thread] = uint(bitCount(used));
    barrier();
    for (uint distance = 1u; distance < threads; distance *= 2u) {
        const uint before = thread >= distance ? counts[thread - distance] : 0u;
        barrier();
        counts[thread] += before;
        barrier();
    }
}

// Neighboring slices become one. Leaves what its thread's word uses of them.
struct Resolution {
    uint halvings, slices, used;
};
void halve(uint thread, inout Resolution at) {
    const uvec2 words = uvec2(coarser_word(thread), coarser_word(thread + threads));
    barrier();
    covered[thread] = words.x;
    covered[thread + threads] = words.y;
    barrier();
    const uint slices = at.slices / 2u;
    at = Resolution(at.halvings + 1u, slices, used_word(thread, slices));
    sum_up(thread, at.used);
}

// `before` and `after`: whether the slices beside the word are used.
void write_entries(uint thread, uint used, uint before, uint after) {
    uint count = counts[thread] - uint(bitCount(used));
    for (uint bit = 0u; bit < 32u; ++bit) {
        const uint slice = 32u * thread + bit;
        const bool here = (used >> bit & 1u) != 0u;
        const bool nearer = (bit > 0u ? used >> (bit - 1u) & 1u : before) != 0u;
        const bool farther = (bit < 31u ? used >> (bit + 1u) & 1u : after) != 0u;
        if (here) warp_entries[most_virtual_slices + count++] = slice;
        uint entry = count;
        if (here) entry |= warp_used;
        if (here && !nearer) entry |= warp_begin;
        if (here && !farther) entry |= warp_end;
        warp_entries[slice] = entry;
    }
}

void main() {
    const uint thread = gl_LocalInvocationIndex;
    covered[thread] = halves[thread];
    covered[thread + threads] = halves[thread + threads];
    barrier();
    Resolution at = Resolution(0u, push.finest_slices, used_word(thread, push.finest_slices));
    sum_up(thread, at.used);
    while (counts[threads - 1u] > push.slices - push.interfaces) halve(thread, at);
    const uint fitting = at.halvings;
    if (thread == 0u) kept = kept_halvings(fitting);
    barrier();
    while (at.halvings < kept) halve(thread, at);
    const uint before = thread > 0u ? used_word(thread - 1u, at.slices) >> 31u : 0u;
    const uint after = used_word(thread + 1u, at.slices) & 1u;
    write_entries(thread, at.used, before, after);
    if (thread > 0u) return;
    warp = WarpHeader(at.halvings, at.slices, counts[threads - 1u], fitting);
    counters.slices_used = counts[threads - 1u];
    counters.virtual_slices = at.slices;
    counters.halvings = at.halvings;
    counters.halvings_held = at.halvings - fitting;
}
