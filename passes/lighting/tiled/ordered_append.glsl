// A group of 256 threads appends to a list in the order of its threads: a bit per thread, and the place of each is the number of
// bits below it. Lists are the same on every run and in index order without a sort; atomics for places would give neither.
#ifndef PASSES_LIGHTING_TILED_ORDERED_APPEND_GLSL
#define PASSES_LIGHTING_TILED_ORDERED_APPEND_GLSL

shared uint group_bits[tile_threads / 32u];

// x: how many threads before this one have something; y: how many of all do. Every thread of the group must come here.
uvec2 place_in_group(bool has_one) {
    const uint thread = gl_LocalInvocationIndex, word = thread / 32u, words = tile_threads / 32u;
    if (thread < words) group_bits[thread] = 0u;
    barrier();
    if (has_one) atomicOr(group_bits[word], 1u << (thread & 31u));
    barrier();
    uvec2 place = uvec2(0u);
    for (uint i = 0u; i < words; ++i) {
        const uint bits = group_bits[i];
        const uint below = i < word ? bits : i > word ? 0u : bits & ((1u << (thread & 31u)) - 1u);
        place += uvec2(bitCount(below), bitCount(bits));
    }
    barrier();
    return place;
}

#endif
