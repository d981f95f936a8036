// The lists of a band as a step reads them that comes after make_lists(): read_lists() binds what is declared here and in places.glsl.
#ifndef PASSES_TRANSPARENCY_LIST_FRAGMENTS_GLSL
#define PASSES_TRANSPARENCY_LIST_FRAGMENTS_GLSL
#include "passes/transparency/lists/places.glsl"

layout(set = 0, binding = 4, scalar) readonly buffer Keys { ListKey keys[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Fragments { ListFragment fragments[]; };

#endif
