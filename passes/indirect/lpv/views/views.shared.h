// What the views of light propagation volumes share with their shaders.
#ifndef PASSES_INDIRECT_LPV_VIEWS_SHARED_H
#define PASSES_INDIRECT_LPV_VIEWS_SHARED_H
#include "passes/indirect/lpv/lpv.shared.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

struct SpheresPush {
    GridPlace grid;
    uint number;  // of the grid, in the order in which a place takes the first that holds it
};

#ifdef __cplusplus
}
#endif
#endif
