// Sorts every list of the band in place, one thread per cell; lists of more than chunk_keys keys are left to sort_chunks.comp.
// A shell sort with gaps shrinking by 5/11 (Gonnet and Baeza-Yates 1991); short lists are insertion sorted by its last round.
// Not a bubble sort: lavapipe 22.3 miscompiles that, silently, from 8 elements on with run-time bounds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/transparency/lists/order.glsl"

layout(push_constant, scalar) uniform Push { Band band; };
#include "passes/shaders/finished.glsl"
#include "passes/transparency/lists/places.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const uint sorts_chunks = 0u;  // 1: lists can have more than chunk_keys
layout(set = 0, binding = 4, scalar) buffer Keys { ListKey keys[]; };
layout(set = 0, binding = 5, scalar) buffer Chunks { ListChunks chunks; ListChunk chunk[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { ListCounters counters; };

// Insertion sort of every gap-th key.
void sort_gapped(uint first, uint count, uint gap) {
    for (uint i = gap; i < count; ++i) {
        const ListKey key = keys[first + i];
        const ListSubmission own = submissions[key.fragment];
        uint at = i;
        while (at >= gap) {
            const ListKey other = keys[first + at - gap];
            if (!comes_first(key, own, other)) break;
            keys[first + at] = other;
            at -= gap;
        }
        keys[first + at] = key;
    }
}

// The same by depth alone. Returns whether two depths are equal: with a gap of 1 a key always meets the nearest one that is not deeper.
bool sort_gapped_by_depth(uint first, uint count, uint gap) {
    bool ties = false;
    for (uint i = gap; i < count; ++i) {
        const ListKey key = keys[first + i];
        uint at = i;
        while (at >= gap) {
            const ListKey other = keys[first + at - gap];
            ties = ties || key.z == other.z;
            if (key.z >= other.z) break;
            keys[first + at] = other;
            at -= gap;
        }
        keys[first + at] = key;
    }
    return ties;
}

// Up to 12 keys plain insertion moves less than a first gapped round would save.
uint first_gap(uint count) { return count > 12u ? count * 5u / 11u : 1u; }

void sort_by_order(uint first, uint count) {
    for (uint gap = first_gap(count); gap > 1u; gap = gap * 5u / 11u) sort_gapped(first, count, gap);
    sort_gapped(first, count, 1u);
}

bool sort_by_depth(uint first, uint count) {
    for (uint gap = first_gap(count); gap > 1u; gap = gap * 5u / 11u) sort_gapped_by_depth(first, count, gap);
    return sort_gapped_by_depth(first, count, 1u);
}

// Submissions, two words more of every key, are looked at only where depths are equal: all is sorted again then, and only keys of equal
// depth change places.
void sort_list(uint first, uint count) {
    const bool by_depth = list_order == list_order_depth;
    const bool again = by_depth ? sort_by_depth(first, count) : true;
    sort_by_order(first, again ? count : 0u);
}

void append_chunks(uint first, uint count) {
    const uint number = (count + chunk_keys - 1u) / chunk_keys;
    const uint begin = atomicAdd(chunks.count, number);
    for (uint i = 0u; i < number; ++i) chunk[begin + i] = ListChunk(first, count, i);
    atomicMax(chunks.groups.x, min(begin + number, most_chunk_groups));
    atomicMax(chunks.groups.y, 1u);
    atomicMax(chunks.groups.z, 1u);
}

void main() {
    const uvec3 at = gl_GlobalInvocationID;
    if (at.x >= band.width || at.y >= band.rows) return;
    const uint cell = cell_of(uvec2(at.x, at.y + band.first_row), at.z);
    const uint start = starts[cell], count = list_count(cell);
    if (sorts_chunks != 0u && count > chunk_keys) append_chunks(start, count);
    else sort_list(start, count);
    if (!finished(band.width)) atomicAdd(counters.unfinished, 1u);

    const uint together = subgroupAdd(count), longest = subgroupMax(count);
    if (subgroupElect()) {
        atomicAdd(counters.fragments, together);
        atomicAdd(counters.atomics, together);  // one each found its slot
        atomicMax(counters.deepest, longest);
    }
}
