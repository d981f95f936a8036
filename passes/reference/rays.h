// Rays against the capture's triangles, in double: closest hit and visibility.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h

struct Hit {
    double distance = 0;
    std::uint32_t draw = 0, triangle = 0;
    glm::dvec3 barycentric{0};
    glm::dvec3 across{0};  ///< perpendicular to the triangle, to either side, as long as twice its area
    bool front_facing = true;
};

enum class RayMask { opaque, shadow_casters };

/// A bounding volume hierarchy over a frame's opaque and masked draws, view space. Both faces of every triangle are hit;
/// masked ones only where their alpha (texture at mip 0) reaches the cutoff. Keeps a reference to the frame.
class RayScene {
public:
    RayScene(const Frame&, RayMask);
    /// Nearest hit with begin < distance < end; direction need not be unit (distance is in its lengths). At equal distance
    /// the first in submission order.
    std::optional<Hit> closest(glm::dvec3 origin, glm::dvec3 direction, double begin, double end) const;
    /// Whether nothing lies between begin and end.
    bool clear(glm::dvec3 origin, glm::dvec3 direction, double begin, double end) const;

private:
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t first = 0, count = 0;  ///< leaf: triangles; inner: first child, count 0
    };
    struct Triangle {
        glm::dvec3 a, b, c;
        std::uint32_t draw, triangle;
        double handedness;  ///< of the draw's transform
    };
    /// A part of a ray.
    struct Span;
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
    bool solid(const Triangle&, const glm::dvec3& barycentric) const;  ///< alpha test
    std::optional<Hit> intersect(const Triangle&, const Span&) const;
    /// Calls accept(hit) for the hits in the span; it may shorten the span, and returns whether to go on.
    template <typename Accept>
    void traverse(Span&, const Accept&) const;

    const Frame* frame_;
    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;
};

/// A place on a surface that rays leave, view space.
struct Departure {
    glm::dvec3 position{0}, normal{0};  ///< the side that they leave to
    std::optional<std::uint32_t> draw;  ///< whose surface it is, if that is known

    /// The nearest hit up to a distance, but for surfaces that coincide with this one, and for its facets, which its normals show
    /// as round: hits of the same draw, within 60 degrees of the tangent plane, that lie less above it than the error of the
    /// coarsest G-buffer's depth.
    std::optional<Hit> closest(const RayScene&, const glm::dvec3& direction, double end) const;
};

/// The point of the scene that the eye sees at a position that a G-buffer gave. If it sees none within the error of the coarsest
/// G-buffer's depth: off_surface_of_depth(), which is nearer to everything and gets .09 % more light from 1 m away.
Departure seen_surface(const RayScene&, const glm::dvec3& position, const glm::dvec3& normal);

/// The position, in view space, lifted off its surface by the error of the coarsest G-buffer's depth.
glm::dvec3 off_surface_of_depth(const glm::dvec3& position, const glm::dvec3& normal);

}  // namespace strata
