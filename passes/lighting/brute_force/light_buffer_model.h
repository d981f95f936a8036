// The talk's light buffer and table of materials in double, from docs/algorithms/deferred.md 1.5 and 1.6.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/reference/shade.h"

namespace strata::lighting {

/// Diffuse and specular share of a slice as the formulas have them: cosines of light and halfway vector in 0..1.
glm::dvec2 material_formula(std::uint32_t slice, double n_l, double n_h);

/// The same out of the table: 8 bits, bilinear.
struct TableShares {
    glm::dvec2 shares{0};
    bool undecided = false;  ///< a float may round one of the texels to another byte
};
TableShares material_in_table(std::uint32_t slice, double n_l, double n_h);

/// What a surface reflects of a light at these settings, and whether the table's rounding leaves that open.
struct Accumulated {
    glm::dvec3 radiance{0};
    bool undecided = false;
};
Accumulated accumulated(const Frame&, const SurfacePoint&, const Light&, const BruteForceParams&);

}  // namespace strata::lighting
