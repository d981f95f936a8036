// What cells ever held, summed over all steps, as those read it who come after propagation.
#ifndef PASSES_INDIRECT_LPV_READ_TOTAL_GLSL
#define PASSES_INDIRECT_LPV_READ_TOTAL_GLSL
#include "passes/indirect/lpv/stored_cells.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Total { uint total[]; };

vec4 total_channel(uint cell, uint channel) {
    const uint at = total_word(cell, channel);
    if (has_halves()) return uintBitsToFloat(total[0]) * of_halves(uvec2(total[at], total[at + 1u]));
    return uintBitsToFloat(uvec4(total[at], total[at + 1u], total[at + 2u], total[at + 3u]));
}

// W.
LightCell total_light(uint cell) { return LightCell(total_channel(cell, 0u), total_channel(cell, 1u), total_channel(cell, 2u)); }

// By the way that sources face.
LightCell total_facing(uint cell) { return LightCell(total_channel(cell, 3u), total_channel(cell, 4u), total_channel(cell, 5u)); }

#endif
