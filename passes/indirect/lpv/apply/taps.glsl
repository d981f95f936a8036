// Light that a surface takes of a grid: of the cells around a place before it, without those that a blocker near its macro-cell hides
// (docs/algorithms/lighting.md 5.8).
#ifndef PASSES_INDIRECT_LPV_TAPS_GLSL
#define PASSES_INDIRECT_LPV_TAPS_GLSL
#include "passes/indirect/lpv/apply/tap_places.glsl"
#include "passes/indirect/lpv/read_total.glsl"
#include "passes/indirect/read_grid.glsl"

layout(constant_id = 3) const uint asks_taps = 0u;  // 1: not of cells that a blocker hides

LightCell light_of(uint number) { return total_light(number); }
LightCell facing_of(uint number) { return total_facing(number); }

uint first_facing() { return knows_facing() ? 0u : nowhere; }

SeenLight seen_light_before(GridPlace grid, LitPlace lit, float cells) {
    const uint list = list_before(grid, lit, cells);
    return seen_light_at(grid, lit, GridReading(0u, first_facing(), cells, NearList(list, asks_taps != 0u ? count_near(list) : 0u)));
}

SeenLight seen_light(GridPlace grid, LitPlace lit) { return seen_light_before(grid, lit, reading); }

#endif
