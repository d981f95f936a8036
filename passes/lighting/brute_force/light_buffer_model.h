// The talk's light buffer in double, from docs/algorithms/deferred.md 1.5 and 1.6.
#pragma once

#include <glm/glm.hpp>

#include "passes/lighting/brute_force/brute_force_params.h"
#include "passes/lighting/material_table_model.h"
#include "passes/reference/shade.h"

namespace strata::lighting {

/// What a surface reflects of a light at these settings, and whether the table's rounding leaves that open.
struct Accumulated {
    glm::dvec3 radiance{0};
    bool undecided = false;
};
Accumulated accumulated(const Frame&, const SurfacePoint&, const Light&, const BruteForceParams&);

}  // namespace strata::lighting
