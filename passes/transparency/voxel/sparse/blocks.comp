// Gives blocks of the pool to the words that tiles use, at the finest resolution at which there are enough: the talk's future work,
// "re-allocate at lower resolution on physical overflow" (docs/algorithms/transparency.md 6.13). A group for each tile. Which
// tile's blocks come first is chance, and nobody can tell.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/voxel.shared.h"

layout(push_constant, scalar) uniform Push { VoxelPush push; };

const uint threads = 64u;
layout(local_size_x = threads) in;
layout(constant_id = 0) const uint field_bits = 8u;
layout(constant_id = 1) const uint pool_blocks = 0u;
layout(set = 0, binding = 12, scalar) writeonly buffer DepthWarp {  // as pool.glsl reads it
    WarpHeader warp;
    uint warp_entries[];
};
layout(set = 0, binding = 13, scalar) buffer Tiles { uint tile_bits[]; };
layout(set = 0, binding = 20, scalar) buffer Counters { VoxelCounters counters; };

const uint slices_per_word = 32u / field_bits;
#include "passes/transparency/voxel/sparse/marks.glsl"

shared uint counts[threads];  // of words used in the groups up to each thread's
shared uint first_block;

// At the coarsest a tile has a single word, and the pool has one for every tile (sparse.h).
Resolution chosen_resolution() {
    Resolution r = finest_resolution();
    while (tile_bits[r.halvings] > pool_blocks / push.channels && !is_coarsest(r)) r = coarser(r);
    return r;
}

uint marks_of(Resolution r, uvec2 tile, uint group) { return group < groups_of(r) ? tile_bits[first_mark_of(r, tile) + group] : 0u; }

void sum_up(uint thread) {
    barrier();
    for (uint distance = 1u; distance < threads; distance *= 2u) {
        const uint before = thread >= distance ? counts[thread - distance] : 0u;
        barrier();
        counts[thread] += before;
        barrier();
    }
}

void main() {
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 tile = gl_WorkGroupID.xy;
    const Resolution r = chosen_resolution();
    const uint groups = (push.words + 31u) / 32u, share = (groups + threads - 1u) / threads;
    const uint first = min(thread * share, groups), end = min(first + share, groups);
    uint used = 0u;
    for (uint group = first; group < end; ++group) used += uint(bitCount(marks_of(r, tile, group)));
    counts[thread] = used;
    sum_up(thread);
    if (thread == 0u) first_block = atomicAdd(tile_bits[words_placed], counts[threads - 1u]);
    barrier();
    uint before = first_block + counts[thread] - used;
    for (uint group = first; group < end; ++group) {
        const uint bits = marks_of(r, tile, group), entry = 2u * ((tile.y * tile_extent().x + tile.x) * groups + group);
        warp_entries[entry] = bits;
        warp_entries[entry + 1u] = before;
        before += uint(bitCount(bits));
    }
    if (thread > 0u || tile != uvec2(0u)) return;
    warp = WarpHeader(r.halvings, r.slices, tile_bits[r.halvings], r.halvings);
    counters.virtual_slices = r.slices;
    counters.halvings = r.halvings;
    counters.blocks = tile_bits[r.halvings] * push.channels;
    counters.voxels = pool_blocks * tile_size * tile_size * slices_per_word;
}
