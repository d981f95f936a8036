// Where the words of a sparse volume are: in a pool of blocks, one for each word that a tile of 8 x 8 columns uses and each channel
// (docs/algorithms/transparency.md 6.13). Of each 32 words of a tile a table says which are used and how many of all tiles have a
// place before them. A shader that includes this declares `VoxelPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_POOL_GLSL
#define PASSES_TRANSPARENCY_VOXEL_POOL_GLSL
#include "passes/transparency/voxel/slices/depth_curve.glsl"

uint pool_entry(uvec2 tile, uint group) {
    const uint tiles_across = (push.width + tile_size - 1u) / tile_size;
    return 2u * ((tile.y * tiles_across + tile.x) * ((push.words + 31u) / 32u) + group);
}

uint bits_in_pool(uvec2 tile, uint group) { return warp_entries[pool_entry(tile, group)]; }

bool is_in_pool(uvec2 tile, uint word) { return (bits_in_pool(tile, word / 32u) >> word % 32u & 1u) != 0u; }

// Of a tile's word, or of the last in front of it that is used; -1 if there is none. By channel, channels stand side by side.
int last_block(uvec2 tile, uint word) {
    const uint entry = pool_entry(tile, word / 32u), before = warp_entries[entry + 1u];
    const uint up_to = warp_entries[entry] & 0xffffffffu >> (31u - word % 32u);
    if (up_to == 0u && before == warp_entries[pool_entry(tile, 0u) + 1u]) return -1;
    return int(before) + bitCount(up_to) - 1;
}

ivec3 place_of_block(uvec2 texel, uint channel, uint block) {
    const uint plane = block * push.channels + channel;
    const uvec2 corner = uvec2(plane, plane / pool_blocks_across) % pool_blocks_across * tile_size;
    return ivec3(corner + texel % tile_size, plane / pool_blocks_per_layer);
}

// Of a word that is used; the column's channels lie one below the other, as where nothing is sparse.
ivec3 place_in_pool(ivec2 column, uint word) {
    const uint y = uint(column.y), channel = uint(y >= push.height) + uint(y >= 2u * push.height);
    const uvec2 texel = uvec2(column.x, y - channel * push.height);
    return place_of_block(texel, channel, uint(last_block(texel / tile_size, word)));
}

#endif
