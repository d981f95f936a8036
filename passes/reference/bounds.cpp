// Bounding spheres of draws in view space.
#include "passes/reference/bounds.h"

#include <algorithm>

namespace strata {

Sphere bounding_sphere(const Frame& frame, std::uint32_t draw) {
    const Draw& drawn = frame.draws[draw];
    const auto& positions = frame.meshes[drawn.mesh].positions;
    const auto in_view = [&](glm::dvec3 p) {
        return frame.view.to_view * (glm::dvec3(drawn.to_world * glm::dvec4(p, 1)) - frame.view.origin);
    };
    if (positions.empty()) return {in_view({0, 0, 0}), 0};
    glm::dvec3 low(positions.front()), high(low);
    for (const glm::vec3& position : positions) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    Sphere sphere{in_view(0.5 * (low + high)), 0};
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1u ? high.x : low.x, i & 2u ? high.y : low.y, i & 4u ? high.z : low.z);
        sphere.radius = std::max(sphere.radius, glm::length(in_view(corner) - sphere.center));
    }
    return sphere;
}

}  // namespace strata
