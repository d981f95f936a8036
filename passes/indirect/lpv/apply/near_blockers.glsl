// The blockers near a macro-cell: those that may be in the way between a surface and the cells that it reads
// (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_NEAR_BLOCKERS_GLSL
#define PASSES_INDIRECT_LPV_NEAR_BLOCKERS_GLSL
#include "passes/indirect/lpv/apply/macro_cells.glsl"

layout(constant_id = 5) const uint has_macro_cells = 0u;  // 0: all blockers of the frame are near

layout(set = 0, binding = 7, scalar) readonly buffer MacroCells { uint macro_cells[]; };

// Of a cell that may lie beyond the border: the nearest one.
uint macro_cell(GridPlace grid, ivec3 cell) {
    return macro_index(grid, uvec3(clamp(cell, ivec3(0), ivec3(grid.cells) - 1)) / macro_side);
}

uint near_blockers(uint macro, uint word) {
    return has_macro_cells != 0u ? macro_cells[macro * blocker_words + word] : low_bits(blocker_count - 32u * word);
}

uint count_near(uint macro) {
    uint count = 0u;
    for (uint word = 0u; word < blocker_words; ++word) count += uint(bitCount(near_blockers(macro, word)));
    return count;
}

bool is_stopped_near(uint macro, vec3 from, vec3 to, inout uint tests) {
    for (uint word = 0u; word < blocker_words; ++word)
        for (uint near = near_blockers(macro, word); near != 0u; near &= near - 1u) {
            ++tests;
            if (stops(32u * word + uint(findLSB(near)), from, to)) return true;
        }
    return false;
}

#endif
