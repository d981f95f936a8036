// What the views of edges share with their shaders.
#ifndef PASSES_EDGES_VIEWS_SHARED_H
#define PASSES_EDGES_VIEWS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

const uint shows_surfaces = 0u;
const uint shows_outcome = 1u;

// Pixels by how many surfaces their samples show: none (the sky) to one per sample.
const uint most_surfaces = 4u;

struct SurfaceCounts {
    uint pixels[most_surfaces + 1u];
    uint marked[most_surfaces + 1u];
};

#ifdef __cplusplus
}
#endif
#endif
