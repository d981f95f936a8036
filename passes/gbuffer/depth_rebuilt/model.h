// The codes of the layout with rebuilt depth, in double.
#pragma once

#include <glm/glm.hpp>

namespace strata::gbuffer {

/// The normal as it is read back: octahedral coordinates as 16-bit signed normalized numbers.
glm::dvec3 depth_rebuilt_normal(const glm::dvec3& normal);

}  // namespace strata::gbuffer
