// The half floats of the z-first layout in double.
#pragma once

#include <glm/glm.hpp>

namespace strata::gbuffer {

/// n.z, and (n.x + 1) / 2 with the sign of n.y, as the half floats that are stored.
glm::dvec2 z_first_halves(const glm::dvec3& normal);
glm::dvec3 z_first_normal(const glm::dvec2& halves);

}  // namespace strata::gbuffer
