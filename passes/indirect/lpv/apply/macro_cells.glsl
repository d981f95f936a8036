// Macro-cells of a grid: 4 x 4 x 4 cells each, with a bit per blocker of the frame. As many words as the blockers take: none is left out.
#ifndef PASSES_INDIRECT_LPV_MACRO_CELLS_GLSL
#define PASSES_INDIRECT_LPV_MACRO_CELLS_GLSL
#include "passes/indirect/lit_place.glsl"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/indirect/ways.glsl"

const uint blocker_words = (blocker_count + 31u) / 32u;

uvec3 macro_extent(GridPlace grid) { return (grid.cells + macro_side - 1u) / macro_side; }

uint macro_index(GridPlace grid, uvec3 macro) {
    const uvec3 extent = macro_extent(grid);
    return (macro.z * extent.y + macro.y) * extent.x + macro.x;
}

#endif
