// The half floats of the packed layout in double.
#pragma once

#include <glm/glm.hpp>

namespace strata::gbuffer {

/// q of docs/algorithms/deferred.md 2.4 as the half floats that are stored.
glm::dvec2 packed_halves(const glm::dvec3& normal);
glm::dvec3 packed_normal(const glm::dvec2& halves);

}  // namespace strata::gbuffer
