// Bounding spheres of draws in view space, as models of culling derive them.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h

struct Sphere {
    glm::dvec3 center{0};
    double radius = 0;
};

/// Around every vertex of a draw: the box of its positions in object space brought to view space, its center and half diagonal
/// (the longest, where the transform shears).
Sphere bounding_sphere(const Frame&, std::uint32_t draw);

}  // namespace strata
