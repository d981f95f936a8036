// Where a cell's list lies. A shader that includes this declares `Band band` in its push constants first.
#ifndef PASSES_TRANSPARENCY_EVENT_LISTS_GLSL
#define PASSES_TRANSPARENCY_EVENT_LISTS_GLSL
#include "passes/transparency/lists/event_lists.shared.h"

layout(set = 0, binding = 2, scalar) readonly buffer Starts { uint starts[]; };           // within the group of cells
layout(set = 0, binding = 3, scalar) readonly buffer GroupStarts { uint group_starts[]; };  // of the group's first cell

// To be asked by draws, too, which are restricted to the rows of the band: see DrawPass::in_rows.
bool in_band(uint row) { return row >= band.first_row && row - band.first_row < band.rows; }

// x, y in the frame.
uint cell_of(uvec2 pixel, uint sample_index) {
    return ((pixel.y - band.first_row) * band.width + pixel.x) * band.samples + sample_index;
}

uint list_start(uint cell) { return group_starts[cell / cells_per_group] + starts[cell]; }

// Of `count` fragments, those that have a node. All of them: the pool holds what the band can have
// (passes/scene/fragment_bounds.h), and the counter `dropped` proves it.
uint stored(uint start, uint count) { return min(count, band.pool - min(start, band.pool)); }

#endif
