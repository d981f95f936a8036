// The codes of the octahedral layout in double.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace strata::gbuffer {

/// Codes 0..61438 per axis of a unit vector.
glm::uvec2 octahedral_codes(const glm::dvec3& normal);
glm::dvec3 octahedral_normal(const glm::uvec2& codes);

/// Code 0..61439 of view depth z, and back; depths outside the range take the first and the last code.
std::uint32_t octahedral_depth_code(double z, double near);
double octahedral_depth(std::uint32_t code, double near);

}  // namespace strata::gbuffer
