// How buffers hold the light of cells: as 32-bit floats, W, or as half floats (docs/algorithms/lighting.md 7, N13). Halves are rounded by
// integers, to the nearest, ties to even: how a device rounds where it stores them is its own choice, and lavapipe 22.3 cuts off. There are
// no subnormals, which a device may flush, and no infinity. A cell's step holds what the cell sends, so that it needs no factor beside it.
#ifndef PASSES_INDIRECT_LPV_STORED_CELLS_GLSL
#define PASSES_INDIRECT_LPV_STORED_CELLS_GLSL
#include "passes/indirect/lpv/channels.glsl"
#include "passes/shaders/nearest_half.glsl"

layout(constant_id = 96) const uint cell_storage = storage_float;

bool has_halves() { return cell_storage == storage_half; }

// The first word of a cell's channel in the sum over steps.
uint total_word(uint cell, uint channel) {
    if (has_halves()) return unit_words + 2u * (channels * cell + channel);
    return 4u * (channels * cell + channel);
}

// The same of what a step holds; with floats the shares of a cell's channels follow: what each channel's clamped faces are multiplied by, so
// that the cell sends what it holds.
uint step_word(uint cell, uint channel) {
    if (has_halves()) return 2u * (channels * cell + channel);
    return 5u * channels * cell + 4u * channel;
}
uint share_word(uint cell, uint channel) { return 5u * channels * cell + 4u * channels + channel; }

float power_of_two(int exponent) { return uintBitsToFloat(uint(127 + exponent) << 23); }

// Of a step's unit, in the sums' units.
float step_unit() { return has_halves() ? power_of_two(total_exponent - step_exponent) : 1.0; }

vec4 of_halves(uvec2 words) { return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y)); }

// Two words with halves, four with floats.
uint stored_words() { return has_halves() ? 2u : 4u; }
uvec4 words_of(vec4 light) {
    if (!has_halves()) return floatBitsToUint(light);
    const vec2 low = nearest_half(light.xy), high = nearest_half(light.zw);
    return uvec4(packHalf2x16(low), packHalf2x16(high), 0u, 0u);
}

#endif
