// The types C++ and GLSL share in *.shared.h files. Scalar block layout on both sides: offsets are C's, no padding lore.
#ifndef PASSES_SHADER_INTEROP_H
#define PASSES_SHADER_INTEROP_H
#ifdef __cplusplus
#include <cstdint>

#include <glm/glm.hpp>

namespace strata {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using mat3 = glm::mat3;
using mat4 = glm::mat4;
using ivec2 = glm::ivec2;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
}  // namespace strata
#endif
#endif
