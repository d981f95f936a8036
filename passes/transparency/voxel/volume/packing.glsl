// Words of three channels, red lowest (docs/algorithms/transparency.md 6.4).
#ifndef PASSES_TRANSPARENCY_VOXEL_PACKING_GLSL
#define PASSES_TRANSPARENCY_VOXEL_PACKING_GLSL
#include "passes/transparency/voxel/voxel.shared.h"

layout(constant_id = 17) const uint packs_colors = 0u;  // 1: there are such words

uvec3 color_fields(uint word) { return uvec3(word, word >> color_bits, word >> 2u * color_bits) & ((1u << color_bits) - 1u); }
uint color_word(uvec3 fields) { return fields.r + (fields.g << color_bits) + (fields.b << 2u * color_bits); }

#endif
