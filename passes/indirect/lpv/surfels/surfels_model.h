// Every surface of a frame in small pieces, in double: what the lines through a grid along the three axes meet, wherever light or
// eye are. Where a line along axis a meets a surface of normal n, the piece has the area of the line's texel times |n.a|: of a
// surface of area A the texels are A |n.a|, so that the pieces of the three axes have A (n.x^2 + n.y^2 + n.z^2) = A.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "passes/indirect/lpv/grids_model.h"

namespace strata::indirect::in_double {

struct Surfel {
    glm::dvec3 position{0};   ///< world
    glm::dvec3 normal{0};     ///< outward, unit, as vertices have it
    glm::dvec3 direction{0};  ///< across its triangle, unit, of either side
    double area = 0;          ///< square meters
    glm::dvec3 albedo{0};
    bool has_two_sides = false;
};

/// Of opaque and masked draws in a grid and a cell around it.
std::vector<Surfel> surfels(const Frame&, const Grid&);

}  // namespace strata::indirect::in_double
