// What the links between cells let through.
#ifndef PASSES_INDIRECT_LPV_LINKS_GLSL
#define PASSES_INDIRECT_LPV_LINKS_GLSL
#include "passes/indirect/lpv/propagation/faces.glsl"
#include "passes/indirect/grid.glsl"

layout(constant_id = 3) const uint has_links = 0u;

layout(set = 0, binding = 1, scalar) readonly buffer Links { float links[]; };

// The link between a cell and its neighbor along an axis lies with the lower of the two.
float transmitted(GridPlace grid, ivec3 lower, uint axis) { return has_links == 0u ? 1.0 : links[3u * cell_index(grid, lower) + axis]; }

#endif
