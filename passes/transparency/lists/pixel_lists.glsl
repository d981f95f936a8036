// The cells of a band. A shader that includes this declares `Band band` in its push constants first.
#ifndef PASSES_TRANSPARENCY_PIXEL_LISTS_GLSL
#define PASSES_TRANSPARENCY_PIXEL_LISTS_GLSL
#include "passes/transparency/lists/pixel_lists.shared.h"

// To be asked by draws, too, which are restricted to the rows of the band: see DrawStep::in_rows.
bool in_band(uint row) { return row >= band.first_row && row - band.first_row < band.rows; }

// x, y in the frame.
uint cell_of(uvec2 pixel, uint sample_index) {
    return ((pixel.y - band.first_row) * band.width + pixel.x) * band.samples + sample_index;
}

uint cells_of_band() { return band.width * band.rows * band.samples; }

#endif
