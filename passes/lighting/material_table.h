// Makes the talk's table of materials (docs/algorithms/deferred.md 1.6).
#pragma once

#include "passes/graph/step.h"

namespace strata {

class Graph;  // passes/graph/graph.h

}  // namespace strata

namespace strata::lighting {

/// What shaders that include passes/lighting/material_table.glsl sample as "material_table": four layers of 128 x 256 bytes
/// twice.
Image material_table(Graph&);

}  // namespace strata::lighting
