// Bounding spheres of draws in view space: what the scene uploads, what culling tests and what shadow maps must contain.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "capture_format/frame.h"

namespace strata {

/// In object space.
struct Box {
    glm::dvec3 low{0}, high{0};
};
/// Around the points; the origin alone where there are none.
Box bounding_box(std::span<const glm::vec3> positions);

struct Sphere {
    glm::dvec3 center{0};
    double radius = 0;
};

/// Around every vertex of a draw: the box of its positions in object space brought to view space, its center and half diagonal
/// (the longest, where the transform shears). The scene's DrawRecord::bound_center and bound_radius are this, rounded.
Sphere bounding_sphere(const Frame&, std::uint32_t draw);
/// The same for a draw whose mesh's box is known.
Sphere bounding_sphere(const Frame&, const Draw&, const Box&);

}  // namespace strata
