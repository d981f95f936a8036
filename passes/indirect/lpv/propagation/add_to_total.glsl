// What a step or a further bounce adds to what cells ever held.
#ifndef PASSES_INDIRECT_LPV_ADD_TO_TOTAL_GLSL
#define PASSES_INDIRECT_LPV_ADD_TO_TOTAL_GLSL
#include "passes/indirect/lpv/stored_cells.glsl"

layout(set = 0, binding = 3, scalar) buffer Total { uint total[]; };

// In the sum's unit.
vec4 add_to_channel(uint cell, uint channel, vec4 light) {
    const uint at = total_word(cell, channel);
    vec4 sum = light;
    if (has_halves()) sum += of_halves(uvec2(total[at], total[at + 1u]));
    else sum += uintBitsToFloat(uvec4(total[at], total[at + 1u], total[at + 2u], total[at + 3u]));
    const uvec4 words = words_of(sum);
    for (uint i = 0u; i < stored_words(); ++i) total[at + i] = words[i];
    return sum;
}

#endif
