// Sorts the chunks of the lists that sort.comp left as they are, one workgroup per chunk: a bitonic sort (Batcher 1968) in shared
// memory. Its turns do not depend on the data.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/order.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0, scalar) readonly buffer Chunks { ListChunks chunks; ListChunk chunk[]; };
layout(set = 0, binding = 1, scalar) buffer Keys { ListKey keys[]; };

const uint threads = chunk_keys / 2u;
shared ListKey sorted[chunk_keys];

// Comes after every key, in both orders.
ListKey padding() {
    const uint last = list_order == list_order_submission ? 0xffffffffu : 0u;
    return ListKey(uintBitsToFloat(0x7f800000u), last, last, 0u);
}

void order_pair(uint pair, uint run, uint apart) {
    const uint i = 2u * pair - (pair & (apart - 1u)), j = i + apart;
    const ListKey a = sorted[i], b = sorted[j];
    if (comes_first(b, a) != ((i & run) == 0u)) return;
    sorted[i] = b;
    sorted[j] = a;
}

void sort_chunk(uint first, uint count) {
    const uint thread = gl_LocalInvocationIndex;
    for (uint i = thread; i < chunk_keys; i += threads) {
        if (i < count) sorted[i] = keys[first + i];
        else sorted[i] = padding();
    }
    barrier();
    for (uint run = 2u; run <= chunk_keys; run *= 2u)
        for (uint apart = run / 2u; apart > 0u; apart /= 2u) {
            order_pair(thread, run, apart);
            barrier();
        }
    for (uint i = thread; i < min(count, chunk_keys); i += threads) keys[first + i] = sorted[i];
    barrier();
}

void main() {
    for (uint i = gl_WorkGroupID.x; i < chunks.count; i += gl_NumWorkGroups.x) {
        const uint first = chunk[i].place * chunk_keys;
        sort_chunk(chunk[i].list + first, chunk[i].keys - first);
    }
}
