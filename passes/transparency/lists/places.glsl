// Where the list of a cell lies, for who reads it: read_places() binds what is declared here.
#ifndef PASSES_TRANSPARENCY_LIST_PLACES_GLSL
#define PASSES_TRANSPARENCY_LIST_PLACES_GLSL
#include "passes/transparency/lists/starts.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer Ends { uint ends[]; };

// Fragments that have a node. All of them: the pool holds what the band can have (passes/scene/fragment_bounds.h), and the counters
// `dropped` and `miscounted` prove it.
uint list_count(uint cell) { return min(ends[cell], room_end(cell)) - min(starts[cell], band.pool); }

#endif
