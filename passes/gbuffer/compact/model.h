// The codes of the compact layout in double.
#pragma once

#include <glm/glm.hpp>

#include "passes/reference/shade.h"

namespace strata::gbuffer {

/// The normal as it is read back: octahedral coordinates as 10-bit signed normalized numbers.
glm::dvec3 compact_normal(const glm::dvec3& normal);

/// The point with lighting model, metallic and occlusion as 2 and 10 bits keep them.
SurfacePoint compact_material(SurfacePoint);

}  // namespace strata::gbuffer
