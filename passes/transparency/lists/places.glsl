// Where the list of a cell lies, for who reads it: read_places() binds what is declared here.
#ifndef PASSES_TRANSPARENCY_LIST_PLACES_GLSL
#define PASSES_TRANSPARENCY_LIST_PLACES_GLSL
#include "passes/transparency/lists/pixel_lists.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer Ends { uint ends[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Starts { uint starts[]; };

// Fragments that have a node. All of them: the pool holds what the band can have (passes/scene/fragment_bounds.h), and the counter
// `dropped` proves it.
uint list_count(uint cell) { return min(ends[cell], band.pool) - min(starts[cell], band.pool); }

#endif
