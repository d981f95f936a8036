// What the views of light propagation volumes share with their shaders.
#ifndef PASSES_INDIRECT_LPV_VIEWS_SHARED_H
#define PASSES_INDIRECT_LPV_VIEWS_SHARED_H
#include "passes/indirect/lpv/lpv.shared.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

// What spheres in cells are shaded by.
const uint spheres_received = 0u;  // irradiance / pi on a white diffuse surface in the cell, as in the image indirect: W/(m^2 sr)
const uint spheres_sent = 1u;      // the radiant intensity that the cell sends along the sphere's normal: W/sr

struct SpheresPush {
    GridPlace grid;
    uint number;  // of the grid, in the order in which a place takes the first that holds it
};

#ifdef __cplusplus
}
#endif
#endif
