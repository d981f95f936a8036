// Meshes of a frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"

namespace strata {

/// Triangles. Optional streams are empty or as long as positions; indices are triples into them.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< object space, meters
    std::vector<glm::vec3> normals;    ///< unit
    std::vector<glm::vec4> tangents;   ///< xyz unit, w the sign of the bitangent
    std::vector<glm::vec2> uv0, uv1;   ///< v grows downwards
    std::vector<glm::vec4> colors;     ///< linear, unpremultiplied
    std::vector<std::uint32_t> indices;
};

}  // namespace strata
