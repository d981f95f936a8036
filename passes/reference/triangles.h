// The triangles of a draw or an emitter in view space, in double: corners, attributes, and what a ray from the eye meets.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace strata {

struct Frame;     // capture_format/frame.h
struct Material;  // capture_format/frame/material.h

/// How the object space of a draw lies in view space. Exact in double however far the world's origin is.
struct DrawSpace {
    glm::dmat3 linear{1};   ///< object to view, without translation
    glm::dvec3 offset{0};   ///< where the object's origin is
    glm::dmat3 normals{1};  ///< inverse transpose of linear: keeps normals outward under mirroring
    double handedness = 1;  ///< sign of linear's determinant: -1 turns the winding around
};
DrawSpace draw_space(const Frame&, std::uint32_t draw);

/// Null for emitters, which have none.
const Material* material_of(const Frame&, std::uint32_t draw);
/// Triangles of a draw, or two per particle of emitter draw - draws.size().
std::uint32_t triangle_count(const Frame&, std::uint32_t draw);

using Corners = std::array<glm::dvec3, 3>;
/// Indices of a mesh draw's triangle.
std::array<std::uint32_t, 3> corner_indices(const Frame&, std::uint32_t draw, std::uint32_t triangle);
/// View-space corners; `space` must be draw_space of the draw.
Corners view_corners(const Frame&, const DrawSpace& space, std::uint32_t draw, std::uint32_t triangle);

/// Vertex attributes at a point of a triangle. Absent streams read as zero, colors as white.
struct Attributes {
    glm::dvec3 normal{0};   ///< object space, not normalized; zero where the mesh has none
    glm::dvec4 tangent{0};  ///< object space
    std::array<glm::dvec2, 2> uv{};
    glm::dvec4 color{1};  ///< particles: color and alpha
    glm::dvec3 emissive{0};
    double depth_offset = 0;
};
Attributes attributes_at(const Frame&, std::uint32_t draw, std::uint32_t triangle, const glm::dvec3& barycentric);

/// What rays from the eye see of a triangle's plane. With edges e1, e2 and corner a, the point a + b1 e1 + b2 e2 = z ray has
/// z = volume / (ray . area), b1 = (ray . first) / (ray . area), b2 = (ray . second) / (ray . area): no clipping is needed.
struct TriangleRays {
    explicit TriangleRays(const Corners&);
    glm::dvec3 barycentric(const glm::dvec3& ray) const;
    /// 1 / z of the point; linear in the ray.
    double inverse_z(const glm::dvec3& ray) const { return glm::dot(ray, area) / volume; }

    glm::dvec3 area, first, second;
    double volume;  ///< 0: the plane goes through the eye
};

}  // namespace strata
