// Macro-cells of a grid: 4 x 4 x 4 cells each, with a list of the blockers near them: a bit per blocker of the frame. As many words as the
// blockers take: none is left out.
#ifndef PASSES_INDIRECT_MACRO_CELLS_GLSL
#define PASSES_INDIRECT_MACRO_CELLS_GLSL
#include "passes/indirect/lit_place.glsl"
#include "passes/indirect/ways.glsl"

const uint blocker_words = (blocker_count + 31u) / 32u;
const uint texels_per_list = (blocker_words + list_words_per_texel - 1u) / list_words_per_texel;  // in volume_light

uvec3 macro_extent(GridPlace grid) { return (grid.cells + macro_side - 1u) / macro_side; }

uint macro_index(GridPlace grid, uvec3 macro) {
    const uvec3 extent = macro_extent(grid);
    return (macro.z * extent.y + macro.y) * extent.x + macro.x;
}

// The macro-cell of the place some cells before a surface, which may lie beyond the border: of the nearest cell.
uint macro_cell_before(GridPlace grid, LitPlace lit, float cells) {
    const ivec3 cell = ivec3(floor(place_before(grid, lit, cells)));
    return macro_index(grid, uvec3(clamp(cell, ivec3(0), ivec3(grid.cells) - 1)) / macro_side);
}

#endif
