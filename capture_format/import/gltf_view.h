// Where an imported frame is seen from: a camera of the file, or one that frames the scene.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/import/gltf.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/import/seen.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// An axis-aligned box in the world; empty until something is in it.
struct Bounds {
    glm::dvec3 low{1e300}, high{-1e300};

    bool empty() const { return low.x > high.x; }
    glm::dvec3 center() const { return empty() ? glm::dvec3(0) : (low + high) * 0.5; }
    double radius() const { return empty() ? 1 : glm::length(high - low) * 0.5; }
    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// What a camera on a node sees; fails, with what is wrong, for cameras that have no such view. Sets no extent.
Result<View> camera_view(const CameraSource&, const glm::dmat4& to_world, double width_over_height);

/// A view from the options' eye to their target, or to the middle of the bounds. Sets no extent.
View placed_view(const Bounds&, const GltfOptions&);

/// The level view from within the bounds, at the height of their middle, that sees farthest on average: of 25 places and 8
/// directions, as far as the largest triangles tell. Sets no extent.
View inside_view(std::vector<WorldTriangle>, const Bounds&, const GltfOptions&);

/// A view of all these points, which lie in these bounds, as near as it may be from the side that the options name. Sets no
/// extent.
View framing_view(std::span<const glm::dvec3> points, const Bounds&, const GltfOptions&);

}  // namespace strata::gltf
