// What cells hold before a step.
#ifndef PASSES_INDIRECT_LPV_READ_STEP_GLSL
#define PASSES_INDIRECT_LPV_READ_STEP_GLSL
#include "passes/indirect/lpv/stored_cells.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Before { uint before[]; };

vec4 before_channel(uint cell, uint channel) {
    const uint at = step_word(cell, channel);
    if (has_halves()) return of_halves(uvec2(before[at], before[at + 1u]));
    return uintBitsToFloat(uvec4(before[at], before[at + 1u], before[at + 2u], before[at + 3u]));
}

// Halves hold what the cell sends.
float share_before(uint cell, uint channel) {
    if (has_halves()) return 1.0;
    return uintBitsToFloat(before[share_word(cell, channel)]);
}

#endif
