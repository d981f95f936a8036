// Bounding spheres of draws in view space.
#include "passes/reference/bounds.h"

#include <algorithm>

#include "passes/reference/shade.h"

namespace strata {

Box bounding_box(std::span<const glm::vec3> positions) {
    if (positions.empty()) return {};
    Box box{positions.front(), positions.front()};
    for (const glm::vec3& position : positions) {
        box.low = glm::min(box.low, glm::dvec3(position));
        box.high = glm::max(box.high, glm::dvec3(position));
    }
    return box;
}

Sphere bounding_sphere(const Frame& frame, std::uint32_t draw) {
    const Draw& drawn = frame.draws[draw];
    return bounding_sphere(frame, drawn, bounding_box(frame.meshes[drawn.mesh].positions));
}

Sphere bounding_sphere(const Frame& frame, const Draw& draw, const Box& box) {
    const auto in_view = [&](const glm::dvec3& p) { return to_view(frame, glm::dvec3(draw.to_world * glm::dvec4(p, 1))); };
    Sphere sphere{in_view(0.5 * (box.low + box.high)), 0};
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1u ? box.high.x : box.low.x, i & 2u ? box.high.y : box.low.y,
                                i & 4u ? box.high.z : box.low.z);
        sphere.radius = std::max(sphere.radius, glm::length(in_view(corner) - sphere.center));
    }
    return sphere;
}

}  // namespace strata
