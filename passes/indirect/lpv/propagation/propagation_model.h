// Light that travels from cell to cell, in double (docs/algorithms/lighting.md 5.4; Kaplanyan, Dachsbacher, Cascaded Light
// Propagation Volumes for Real-Time Indirect Illumination, I3D 2010).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "passes/indirect/cells_model.h"
#include "passes/indirect/lpv/lpv.shared.h"

namespace strata::indirect::in_double {

/// The cells of a grid, and how much light passes from each to its + neighbors.
struct Links {
    glm::uvec3 cells{1};
    std::vector<glm::dvec3> open = {};  ///< by cell_index(): shares 0 to 1 along x, y, z; empty: everything passes
};

/// What a propagating face may hold (propagation_*), how it is evaluated (faces_*), and which way the light goes that it takes
/// (lobes_*).
struct PropagationRule {
    uint propagation = propagation_linear;
    uint faces = faces_centre;
    uint lobes = lobes_face;
};

/// What arrives at a neighbor's cell of the light in a cell: the neighbor lies along +axis (sign 1) or -axis (sign -1).
struct Travel {
    glm::length_t axis = 0;
    double sign = 1;
};
glm::dvec4 arriving(const glm::dvec4& source, const Travel&, const PropagationRule&);
/// Factor on what a cell sends: 1 but for propagation_energy_true.
double sent_share(const glm::dvec4& source, const PropagationRule&);

/// One step: what every cell receives of its six neighbors. Light that leaves the grid is lost.
Channel next_step(const Links&, const Channel&, const PropagationRule&);
/// The sum of `injected` and of what every step after it gave.
Channel propagated(const Links&, const Channel& injected, const PropagationRule&, std::uint32_t iterations);

}  // namespace strata::indirect::in_double
