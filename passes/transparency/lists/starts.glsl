// Where the list of a cell begins, and where the next one does. A shader that includes this declares `Band band` in its push
// constants first.
#ifndef PASSES_TRANSPARENCY_LIST_STARTS_GLSL
#define PASSES_TRANSPARENCY_LIST_STARTS_GLSL
#include "passes/transparency/lists/pixel_lists.glsl"

layout(set = 0, binding = 2, scalar) readonly buffer Starts { uint starts[]; };

// Behind the last node that was counted for the cell; the last cell of a band has the rest of the pool.
uint room_end(uint cell) { return cell + 1u < cells_of_band() ? min(starts[cell + 1u], band.pool) : band.pool; }

#endif
