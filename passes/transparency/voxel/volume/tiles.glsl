// Which words of a tile of columns are splatted to or read: a bit each, by each source where there are two. A shader that includes
// this declares `VoxelPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_TILES_GLSL
#define PASSES_TRANSPARENCY_VOXEL_TILES_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/volume/packing.glsl"
#include "passes/transparency/voxel/sparse/pool.glsl"

layout(constant_id = 16) const uint skips = 1u;  // 0: nothing is known of tiles, so all of their words are used
layout(set = 0, binding = 13, scalar) buffer Tiles { uint tile_bits[]; };

uint first_bits_of(uvec2 tile, uint source) {
    const uvec2 tiles = (uvec2(push.width, push.height) + tile_size - 1u) / tile_size;
    return ((source * tiles.y + tile.y) * tiles.x + tile.x) * ((push.words + 31u) / 32u);
}

bool is_used(uvec2 tile, uint word, uint source) {
    if (sparse != 0u) return is_in_pool(tile, word);
    return skips == 0u || (tile_bits[first_bits_of(tile, source) + word / 32u] >> word % 32u & 1u) != 0u;
}

// A bit for each of 32 words that any source uses: a loop over what is set costs nothing where nothing is.
uint used_words(uvec2 tile, uint block) {
    if (sparse != 0u) return bits_in_pool(tile, block);
    const uint left = push.words - 32u * block;
    if (skips == 0u) return left < 32u ? (1u << left) - 1u : 0xffffffffu;
    uint bits = tile_bits[first_bits_of(tile, source_gray) + block];
    if (packs_colors != 0u) bits |= tile_bits[first_bits_of(tile, source_color) + block];
    return bits;
}

bool is_used(uvec2 tile, uint word) {
    return is_used(tile, word, source_gray) || packs_colors != 0u && is_used(tile, word, source_color);
}

#endif
