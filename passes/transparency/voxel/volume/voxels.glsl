// The volume as words: fields of slices, nearest lowest. Words are texels of an image: layer = word of a column, channels one below
// the other. Where colors are packed, layers are slices, words of three channels, and behind them lie the words of what is gray.
// A shader that includes this declares `VoxelPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_VOXELS_GLSL
#define PASSES_TRANSPARENCY_VOXEL_VOXELS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/slices/depth_curve.glsl"
#include "passes/transparency/voxel/volume/packing.glsl"
#include "passes/transparency/voxel/sparse/pool.glsl"

layout(constant_id = 10) const uint splat = splat_overflow_minimum;
layout(constant_id = 11) const uint field_bits = 8u;  // 8, 10, 16 or 32
// The nearest slice of a column that overflowed; with splat_overflow_minimum only.
layout(set = 0, binding = 11, scalar) buffer Overflow { uint nearest_overflow[]; };

const uint slices_per_word = 32u / field_bits;
const uint field_mask = 0xffffffffu >> (32u - field_bits);

ivec2 column_of(uvec2 texel, uint channel) { return ivec2(texel.x, texel.y + channel * push.height); }

uint index_of(ivec2 column) { return uint(column.y) * push.width + uint(column.x); }

// Slices are physical ones, of a sparse volume those of words that the tile uses.
ivec3 place_of(ivec2 column, uint slice) {
    if (sparse != 0u) return place_in_pool(column, slice / slices_per_word);
    return ivec3(column, slice / slices_per_word + (packs_colors != 0u ? push.slices : 0u));
}

uint shift_of(uint slice) { return (slice % slices_per_word) * field_bits; }

uint field(uint word, uint shift) { return (word >> shift) & field_mask; }

// Of a channel's integral.
uint full_integral() { return packs_colors != 0u ? color_full_code : push.full_code; }
ivec3 integral_place(uvec2 texel, uint channel, uint slice) {
    return packs_colors != 0u ? ivec3(texel, slice) : place_of(column_of(texel, channel), slice);
}
uint integral_code(uint word, uint channel, uint slice) {
    return packs_colors != 0u ? color_fields(word)[channel] : field(word, shift_of(slice));
}

// Where colors are packed, of what is gray or of the channel.
uint overflow_of(uvec2 texel, uint channel) {
    if (splat != splat_overflow_minimum) return no_overflow;
    if (packs_colors == 0u) return nearest_overflow[index_of(column_of(texel, channel))];
    return min(nearest_overflow[index_of(column_of(texel, 0u))], nearest_overflow[index_of(column_of(texel, 1u + channel))]);
}

#endif
