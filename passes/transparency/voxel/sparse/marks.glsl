// Marks of the words that tiles will use of a sparse volume, at every resolution it may end up with: a bit each, by resolution, then
// by tile (docs/algorithms/transparency.md 6.11 and 6.13). A shader that includes this declares `VoxelPush push` in its push
// constants and `slices_per_word` first.
#ifndef PASSES_TRANSPARENCY_VOXEL_MARKS_GLSL
#define PASSES_TRANSPARENCY_VOXEL_MARKS_GLSL

struct Resolution {
    uint halvings, slices;
    uint begin;  // of its marks
};

Resolution finest_resolution() { return Resolution(0u, push.finest_slices, first_mark); }

uint words_of(Resolution r) { return (r.slices + slices_per_word - 1u) / slices_per_word; }

// Of 32 words.
uint groups_of(Resolution r) { return (words_of(r) + 31u) / 32u; }

bool is_coarsest(Resolution r) { return words_of(r) == 1u; }

uvec2 tile_extent() { return (uvec2(push.width, push.height) + tile_size - 1u) / tile_size; }

Resolution coarser(Resolution r) {
    return Resolution(r.halvings + 1u, r.slices / 2u, r.begin + tile_extent().x * tile_extent().y * groups_of(r));
}

uint first_mark_of(Resolution r, uvec2 tile) { return r.begin + (tile.y * tile_extent().x + tile.x) * groups_of(r); }

#endif
