// The volume as words: fields of slices, nearest lowest. Words are texels of an image: layer = word of a column, channels one below
// the other. A shader that includes this declares `VoxelPush push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_VOXELS_GLSL
#define PASSES_TRANSPARENCY_VOXEL_VOXELS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/transparency/voxel/depth_curve.glsl"

layout(constant_id = 10) const uint splat = splat_overflow_minimum;
layout(constant_id = 11) const uint field_bits = 8u;  // 8, 16 or 32
// The nearest slice of a column that overflowed; with splat_overflow_minimum only.
layout(set = 0, binding = 11, scalar) buffer Overflow { uint nearest_overflow[]; };

const uint slices_per_word = 32u / field_bits;
const uint field_mask = 0xffffffffu >> (32u - field_bits);

ivec2 column_of(uvec2 texel, uint channel) { return ivec2(texel.x, texel.y + channel * push.height); }

uint index_of(ivec2 column) { return uint(column.y) * push.width + uint(column.x); }

// Slices are physical ones.
ivec3 place_of(ivec2 column, uint slice) { return ivec3(column, slice / slices_per_word); }

uint shift_of(uint slice) { return (slice % slices_per_word) * field_bits; }

uint field(uint word, uint shift) { return (word >> shift) & field_mask; }

#endif
