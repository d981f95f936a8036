// Grids of light as the stage that fills them and the stages that read them see them.
#ifndef PASSES_INDIRECT_LIGHT_GRID_SHARED_H
#define PASSES_INDIRECT_LIGHT_GRID_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

// How a cell's light becomes irradiance.
const uint irradiance_face = 0u;  // as of a light half a cell away that sends what the cells do
const uint irradiance_cell = 1u;  // the mean over a cell of what travels through it

// A grid of cubic cells. Positions are relative to the eye, along the world's axes.
struct GridPlace {
    vec3 origin;  // the corner of cell (0, 0, 0)
    float cell;   // meters a side
    uvec3 cells;
};

// Light of a cell: l0 and l1 per channel, as Y = (Y0, Y1 x, Y1 y, Y1 z) in the world's axes, W.
struct LightCell {
    vec4 red, green, blue;
};

// The image volume_light: texels in rows, three to a record. First two records of each grid, then one of each cell (its red,
// green and blue), grid after grid; where a grid knows which way its sources face, one more of each of its cells follows. Of a
// grid:
//   origin xyz, cell    as in GridPlace
//   cells xyz, border   as in GridPlace; meters over which the grid fades at its border
//   asks_taps, rule, count    1: not of cells that a blocker hides; irradiance_*; grids in the image
//   macro_row                 the row where its macro-cells begin; 0: it has none, and taps ask all blockers
//   reading, knows_facing     cells before a surface at which it is read; 1: by the way that sources face
// Then the blockers near each macro-cell of a grid: a bit per blocker, in words of 32. A texel holds two words, each as its lower
// and its upper half: small whole numbers are floats that every driver keeps.
const uint volume_texels_per_row = 4096u;
const uint texels_per_record = 3u;
const uint records_per_grid = 2u;
const uint nowhere = 0xffffffffu;  // in place of a record or a cell
const uint list_words_per_texel = 2u;

// Macro-cells: blocks of cells that share a list of the blockers near them (docs/algorithms/lighting.md 5.8).
const uint macro_side = 4u;  // cells

#ifdef __cplusplus
}
#endif
#endif
