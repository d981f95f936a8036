// Virtual point lights put into the cells of a grid, in double (docs/algorithms/lighting.md 5.3).
#pragma once

#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "passes/indirect/barriers_model.h"
#include "passes/indirect/cells_model.h"

namespace strata::indirect::in_double {

/// A piece of a surface that reflects light as Lambert does. World space.
struct VirtualLight {
    glm::dvec3 position{0}, normal{0, 1, 0};
    glm::dvec3 flux{0};  ///< W per color channel
};

struct InjectionRule {
    double bias = 0.5;                       ///< cells along the normal
    std::span<const Barrier> barriers = {};  ///< that keep lights on their own side; none: lights stay where they are
};

/// The cell that takes a light: the one at its biased position, or the next that no blocker hides from it. Nothing where the
/// biased position is outside the grid or all candidates are hidden.
std::optional<glm::uvec3> receiving_cell(const Grid&, const VirtualLight&, const InjectionRule&);

/// Coefficients of all lights, added in their order.
Field injected(const Grid&, std::span<const VirtualLight>, const InjectionRule&);

}  // namespace strata::indirect::in_double
