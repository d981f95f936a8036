// Virtual point lights put into the cells of a grid, in double (docs/algorithms/lighting.md 5.3).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/indirect/barriers_model.h"
#include "passes/indirect/cells_model.h"

namespace strata::indirect::in_double {

/// A piece of a surface that reflects light as Lambert does. World space.
struct VirtualLight {
    glm::dvec3 position{0}, normal{0, 1, 0};
    glm::dvec3 flux{0};  ///< W per color channel
    /// A blocker of the light lies between it and way_begin(): not injected where blockers stop light.
    bool is_behind_blocker = false;
};

struct InjectionRule {
    double bias = 0.5;                       ///< cells along the normal
    std::span<const Barrier> barriers = {};  ///< that keep lights on their own side; none: lights stay where they are
};

/// The cell that takes a light: the one at its biased position, or the next that no blocker hides from it. Nothing where the
/// biased position is outside the grid, all candidates are hidden or the light is behind a blocker.
std::optional<glm::uvec3> receiving_cell(const Grid&, const VirtualLight&, const InjectionRule&);

/// The same lights by the way that they face: the mean of their channels, times (1 + n.x) / 2, (1 + n.y) / 2 and (1 + n.z) / 2.
std::vector<VirtualLight> by_facing(std::vector<VirtualLight>);

/// Coefficients of all lights, added in their order.
Field injected(const Grid&, std::span<const VirtualLight>, const InjectionRule&);

}  // namespace strata::indirect::in_double
