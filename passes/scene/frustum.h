// Pyramids of rays from a near plane on, without an end, for culling: of the image, or of a light's map.
#pragma once

#include <array>
#include <span>

#include <glm/glm.hpp>

#include "passes/scene/draw_bounds.h"

namespace strata {

struct View;  // capture_format/view.h

class Frustum {
public:
    /// The pyramid of the image, in view space.
    explicit Frustum(const View&);
    /// A pyramid around +z: x and y of what it holds are at most z times the slopes.
    Frustum(glm::dvec2 slopes, double near);

    /// Never false for a sphere that a tile's own tests keep. Those test planes one by one, so that a sphere around the near
    /// plane beside the view passes them: such a one is kept here, too.
    bool meets(const BoundingSphere&) const;
    /// The same of the smallest convex body with these corners. May be true for one that lies beside the frustum near two of its
    /// planes.
    bool meets(std::span<const glm::dvec3> corners) const;
    /// True for a sphere wholly within.
    bool contains(const BoundingSphere&) const;

private:
    double near_;
    std::array<glm::dvec3, 4> inward_{};
};

}  // namespace strata
