// How much light blockers and portals let through between neighboring cells, in double: axial occlusion
// (docs/algorithms/lighting.md 5.6; Kircher, Rendering Technology in Agents of Mayhem, GDC 2018).
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "passes/indirect/barriers_model.h"
#include "passes/indirect/cells_model.h"
#include "passes/indirect/lpv/propagation/propagation_model.h"

namespace strata::indirect::in_double {

/// Occluded share of the face between a cell and its neighbor along +axis, in steps of 1/255; exactly 1 from 0.999 on. The share
/// is of 8 x 8 segments; where a blocker at least 1.5 cells wide and high stops the one between the cells' middles, only portals
/// let light through.
double occlusion(const Grid&, const glm::uvec3& cell, glm::length_t axis, std::span<const Barrier>);

/// Of all links of a grid; everything is open where there is no blocker.
Links links(const Grid&, std::span<const Barrier>);

}  // namespace strata::indirect::in_double
