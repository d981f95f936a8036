#include "passes/scene/draw_bounds.h"

#include <algorithm>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "passes/scene/view_space.h"

namespace strata {

BoundingBox box_around(std::span<const glm::vec3> points) {
    if (points.empty()) return {};
    glm::vec3 low = points.front(), high = low;
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    return {low, high};
}

std::array<glm::dvec3, 8> corners_of(const BoundingBox& box) {
    std::array<glm::dvec3, 8> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners[i] = {i & 1u ? box.high.x : box.low.x, i & 2u ? box.high.y : box.low.y, i & 4u ? box.high.z : box.low.z};
    return corners;
}

double farthest_distance(const BoundingBox& box, const glm::dvec3& from) {
    return glm::length(glm::max(glm::abs(box.low - from), glm::abs(box.high - from)));
}

std::array<glm::dvec3, 8> view_corners_of(const View& view, const BoundingBox& world) {
    std::array<glm::dvec3, 8> corners = corners_of(world);
    for (glm::dvec3& corner : corners) corner = in_view_space(view, corner);
    return corners;
}

BoundingSphere sphere_around(const View& view, const Draw& draw, const BoundingBox& box) {
    const auto placed = [&](const glm::dvec3& p) { return in_view_space(view, glm::dvec3(draw.to_world * glm::dvec4(p, 1))); };
    BoundingSphere sphere{placed(0.5 * (box.low + box.high)), 0};
    for (const glm::dvec3& corner : corners_of(box))
        sphere.radius = std::max(sphere.radius, glm::length(placed(corner) - sphere.center));
    return sphere;
}

DrawBounds draw_bounds(const Frame& frame) {
    DrawBounds bounds;
    for (const Mesh& mesh : frame.meshes) bounds.boxes.push_back(box_around(mesh.positions));
    for (const Draw& draw : frame.draws) bounds.spheres.push_back(sphere_around(frame.view, draw, bounds.boxes[draw.mesh]));
    return bounds;
}

}  // namespace strata
