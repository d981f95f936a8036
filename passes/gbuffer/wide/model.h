// The half floats of the wide layout in double.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "passes/reference/shade.h"

namespace strata::gbuffer {

/// The normal as it is read back: three half floats, made unit again.
glm::dvec3 wide_normal(const glm::dvec3& normal);

/// Half floats of x, y and z, z from the near plane to 65504 m.
glm::dvec3 wide_position(const glm::dvec3& position, double near);

/// Whether a coordinate lies so close to the middle of two half floats that the rounding of a float decides which is stored, and
/// with it visibly where in its pixel, whose center is `center`, the stored position lies.
bool place_hangs_on_rounding(const Frame&, const glm::dvec2& center, const glm::dvec3& exact);

/// Code 0..61433 of lighting model and metallic.
std::uint32_t wide_material_code(const SurfacePoint&);

}  // namespace strata::gbuffer
