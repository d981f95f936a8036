// Bounding spheres of draws in view space: what the scene uploads, what culling tests and what shadow maps must contain.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture_format/frame.h"

namespace strata {

struct Sphere {
    glm::dvec3 center{0};
    double radius = 0;
};

/// Around every vertex of a draw: the box of its positions in object space brought to view space, its center and half diagonal
/// (the longest, where the transform shears). The scene's DrawRecord::bound_center and bound_radius are this, rounded.
Sphere bounding_sphere(const Frame&, std::uint32_t draw);

}  // namespace strata
