// Pixels whose first sample stands for all: those that are no edge (docs/algorithms/deferred.md 3.1). passes/edges/plain_pixels.h
// binds the edges.
#ifndef PASSES_EDGES_PLAIN_PIXELS_GLSL
#define PASSES_EDGES_PLAIN_PIXELS_GLSL

layout(constant_id = 31) const uint has_edges = 0u;

layout(set = 0, binding = 23) uniform usampler2DArray edges;

bool is_plain(ivec2 pixel) { return has_edges != 0u && texelFetch(edges, ivec3(pixel, 0), 0).r == 0u; }

#endif
