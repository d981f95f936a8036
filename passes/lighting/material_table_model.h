// The talk's table of materials in double, from docs/algorithms/deferred.md 1.6.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "passes/lighting/material_table.shared.h"
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

/// Which slice stands for a recorded material, and the gloss that its highlight is multiplied with.
std::uint32_t material_slice(const SurfacePoint&);
double material_gloss(const SurfacePoint&, std::uint32_t slice);

}  // namespace strata::lighting
