// Sorts the chunks of the lists that sort.comp left as they are, one workgroup per chunk: a bitonic sort (Batcher 1968) in shared
// memory. Its iterations do not depend on the data. Every comparison moves the later key to the higher place, and the first step of a run compares
// mirrored places: places beyond the last key count as infinity and need no padding.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/lists/order.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0, scalar) readonly buffer Chunks { ListChunks chunks; ListChunk chunk[]; };
layout(set = 0, binding = 1, scalar) buffer Keys { ListKey keys[]; };

const uint threads = chunk_keys / 2u;
shared ListKey sorted[chunk_keys];

// i < j.
void order_pair(uint i, uint j, uint count) {
    if (j >= count) return;
    const ListKey a = sorted[i], b = sorted[j];
    if (!comes_first(b, a)) return;
    sorted[i] = b;
    sorted[j] = a;
}

void order_mirrored(uint pair, uint run, uint count) {
    const uint half_run = run / 2u, begin = pair / half_run * run, place = pair % half_run;
    order_pair(begin + place, begin + run - 1u - place, count);
}

void order_apart(uint pair, uint apart, uint count) {
    const uint i = 2u * pair - (pair & (apart - 1u));
    order_pair(i, i + apart, count);
}

void sort_chunk(uint first, uint count) {
    const uint thread = gl_LocalInvocationIndex;
    for (uint i = thread; i < min(count, chunk_keys); i += threads) sorted[i] = keys[first + i];
    barrier();
    for (uint run = 2u; run <= chunk_keys; run *= 2u) {
        order_mirrored(thread, run, count);
        barrier();
        for (uint apart = run / 4u; apart > 0u; apart /= 2u) {
            order_apart(thread, apart, count);
            barrier();
        }
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
