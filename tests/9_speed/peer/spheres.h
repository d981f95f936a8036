// The triangles of a capture as one mesh in view space, and the light on them, for the peer to draw.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/result.h"

namespace strata::peer {

struct Vertex {
    glm::vec3 position, normal;  ///< view space
    glm::vec4 color;
};

/// Push constants of every shader.
struct Scene {
    glm::mat4 to_clip;
    glm::vec3 sky;
    std::uint32_t nodes;  ///< number of nodes in the buffer
    glm::vec3 ground;
    std::uint32_t padding;
    glm::vec3 background;
    std::uint32_t width;
    glm::vec3 up;  ///< of the world, in view space
    std::uint32_t height;
};

struct Spheres {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    Scene scene{};
};

/// Vertices that the triangles of a mesh share: all of them, all but the first corner of every triangle, or none.
enum class Sharing { all, all_but_first, none };

/// The first frame of a capture. Fails where the frame has textures, lights, particles, fog or several samples: the peer draws
/// none.
Result<Spheres> read_spheres(const std::filesystem::path&, Sharing);

}  // namespace strata::peer
