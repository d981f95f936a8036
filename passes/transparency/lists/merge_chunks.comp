// Merges pairs of sorted runs of the lists that were sorted in chunks: every key's new place is its place in its own run and the
// number of keys of the other run that come before it, found by binary search. A run without a partner is copied.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/order.glsl"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { uint run; };  // keys of a sorted run
layout(set = 0, binding = 0, scalar) readonly buffer Chunks { ListChunks chunks; ListChunk chunk[]; };
layout(set = 0, binding = 1, scalar) readonly buffer From { ListKey keys[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer To { ListKey merged[]; };

// Keys from `first` to `end` that come before `key`. No two keys of a list are equal.
uint count_before(ListKey key, uint first, uint end) {
    uint low = first, high = end;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (comes_first(keys[middle], key)) low = middle + 1u;
        else high = middle;
    }
    return low - first;
}

// i: place in the list.
void merge_key(uint list, uint count, uint i) {
    const uint own = i / run * run, pair = i / (2u * run) * 2u * run;
    const uint other = own == pair ? min(pair + run, count) : pair, end = min(other + run, count);
    const ListKey key = keys[list + i];
    merged[list + pair + i - own + count_before(key, list + other, list + end)] = key;
}

void main() {
    for (uint i = gl_WorkGroupID.x; i < chunks.count; i += gl_NumWorkGroups.x) {
        const ListChunk c = chunk[i];
        const uint end = min((c.place + 1u) * chunk_keys, c.keys);
        for (uint key = c.place * chunk_keys + gl_LocalInvocationIndex; key < end; key += gl_WorkGroupSize.x)
            merge_key(c.list, c.keys, key);
    }
}
