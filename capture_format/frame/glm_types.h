// What frames take for granted of glm's types.
#pragma once

#include <glm/glm.hpp>

namespace strata {

// An application that links the library with other types than these would hand over other structs.
static_assert(alignof(glm::vec4) == alignof(float) && alignof(glm::dmat4) == alignof(double),
              "frames need glm's packed types: compile without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

}  // namespace strata
