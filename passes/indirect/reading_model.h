// What a place takes of the light in grids, in double (docs/algorithms/lighting.md 5.7 and 5.8).
#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "passes/indirect/barriers_model.h"
#include "passes/indirect/cells_model.h"
#include "passes/indirect/light_grid.shared.h"

namespace strata::indirect::in_double {

/// A grid after propagation.
struct LitGrid {
    Grid grid;
    Field light;
    std::span<const Barrier> tap_barriers = {};  ///< that hide taps from a surface; none: all eight taps count
    /// The mean of the three channels, each source weighted by (1 + n.x) / 2, (1 + n.y) / 2, (1 + n.z) / 2 of its normal; empty
    /// where sources count alike, whichever way they face.
    Field facing = {};
    std::uint32_t irradiance = irradiance_face;
    double reading = 0.5;  ///< cells before a surface at which it is read
    double damping = 0;    ///< exponent; 0: off
};

/// World space. A normal of 0 stands for all directions alike.
struct Receiver {
    glm::dvec3 position{0}, normal{0, 1, 0};
};

/// One channel's coefficients where the grid is read above a receiver, of the eight cells around that place. Cells outside hold
/// 0.
glm::dvec4 sampled(const LitGrid&, std::size_t channel, const Receiver&);
/// Share of one channel's light that damping leaves: ((1 + cosine) / 2)^k, of the angle in four dimensions between the
/// coefficients half a cell before the surface and these less those half a cell behind it; 1 where either is 0.
double kept_share(const glm::dvec4& before, const glm::dvec4& behind, double k);
/// Factor on irradiance that counts light of a source of normal m for 1 - (m . n) of it, 0 to 2: surfaces that face the same way
/// do not see each other.
double share_by_facing(const LitGrid&, const Receiver&);
/// W/m^2 of one grid alone.
glm::dvec3 irradiance(const LitGrid&, const Receiver&);
/// Share of a grid at a position: 0 outside, rising to 1 over its border.
double grid_share(const Grid&, const glm::dvec3& position);
/// W/m^2: each grid takes its share of what the grids before it left. `light_of` gives what one of them alone does.
template <typename LightOf>
glm::dvec3 blended(std::span<const LitGrid> all, const glm::dvec3& position, const LightOf& light_of) {
    glm::dvec3 sum(0);
    double remaining = 1;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double share = grid_share(all[i].grid, position);
        if (share == 0) continue;
        sum += remaining * share * light_of(i);
        remaining *= 1 - share;
    }
    return sum;
}
/// The same where every grid is read at the receiver.
glm::dvec3 blended_irradiance(std::span<const LitGrid>, const Receiver&);

}  // namespace strata::indirect::in_double
