// What cells hold after a step.
#ifndef PASSES_INDIRECT_LPV_WRITE_STEP_GLSL
#define PASSES_INDIRECT_LPV_WRITE_STEP_GLSL
#include "passes/indirect/lpv/propagation/faces.glsl"
#include "passes/indirect/lpv/stored_cells.glsl"

layout(set = 0, binding = 2, scalar) writeonly buffer After { uint after[]; };

void store_step(uint cell, uint channel, vec4 light) {
    const float share = share_sent(light);
    const uint at = step_word(cell, channel);
    uvec4 words = words_of(light);
    if (has_halves()) words = words_of(share * light);
    for (uint i = 0u; i < stored_words(); ++i) after[at + i] = words[i];
    if (!has_halves()) after[share_word(cell, channel)] = floatBitsToUint(share);
}

#endif
