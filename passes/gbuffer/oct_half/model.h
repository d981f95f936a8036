// The half floats of the octahedral layout with halves, in double.
#pragma once

#include <glm/glm.hpp>

namespace strata::gbuffer {

/// Octahedral coordinates as the half floats that are stored.
glm::dvec2 oct_half_coordinates(const glm::dvec3& normal);

}  // namespace strata::gbuffer
