// Bounding boxes of meshes and bounding spheres of draws: what the device culls by and what shadow maps must contain.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Draw;   // capture_format/frame/draw.h
struct Frame;  // capture_format/frame.h
struct View;   // capture_format/view.h

/// In object space; the origin alone where there are no points.
struct BoundingBox {
    glm::dvec3 low{0}, high{0};
};
BoundingBox box_around(std::span<const glm::vec3> points);
std::array<glm::dvec3, 8> corners_of(const BoundingBox&);
/// From a place to the corner that is farthest from it.
double farthest_distance(const BoundingBox&, const glm::dvec3& from);
/// The corners in view space of a box in the world.
std::array<glm::dvec3, 8> view_corners_of(const View&, const BoundingBox& world);

/// In view space.
struct BoundingSphere {
    glm::dvec3 center{0};
    double radius = 0;
};
/// Around the corners of the draw's box as the view has it: its center and longest half diagonal. DrawRecord has it in float.
BoundingSphere sphere_around(const View&, const Draw&, const BoundingBox& of_mesh);

struct DrawBounds {
    std::vector<BoundingBox> boxes;       ///< of Frame::meshes
    std::vector<BoundingSphere> spheres;  ///< of Frame::draws
};
/// Walks every vertex once, however many draws have its mesh.
DrawBounds draw_bounds(const Frame&);

}  // namespace strata
