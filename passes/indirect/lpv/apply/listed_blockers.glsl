// The lists of blockers near macro-cells as this stage finds them, before it hands them on.
#ifndef PASSES_INDIRECT_LPV_LISTED_BLOCKERS_GLSL
#define PASSES_INDIRECT_LPV_LISTED_BLOCKERS_GLSL
#include "passes/indirect/lpv/apply/reading.glsl"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/indirect/near_blockers.glsl"

layout(constant_id = 5) const uint has_macro_cells = 0u;  // 0: all blockers of the frame are near

layout(set = 0, binding = 7, scalar) readonly buffer MacroCells { uint macro_cells[]; };

uint listed_blockers(uint list, uint word) { return macro_cells[list * blocker_words + word]; }

// Those near the place some cells before a surface.
uint list_before(GridPlace grid, LitPlace lit, float cells) {
    return has_macro_cells != 0u ? macro_cell_before(grid, lit, cells) : all_listed;
}

#endif
