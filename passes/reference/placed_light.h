// A light in view space, in double: what the files of passes/reference/lights.h share.
#pragma once

#include <glm/glm.hpp>

#include "passes/reference/lights.h"

namespace strata {

struct PlacedLight {
    const Frame* frame;
    const Light* light;
    glm::dvec3 offset;  ///< of its center from the surface
    glm::dvec3 direction, axis_u, axis_v;
};

PlacedLight placed(const Frame&, const SurfacePoint&, const Light&);

/// The direction from the light towards the surface in its axes (u, v, along), as long as the way.
glm::dvec3 away(const PlacedLight&);

/// Whether a disc or rectangle turns its back.
bool is_behind(const PlacedLight&);
/// Of radiance, between -1 and 1 over the rectangle; 1 without a picture.
glm::dvec3 emitted_color(const PlacedLight&, const glm::dvec2& place, double lod);

/// Real-time and exact form for tubes, spheres, discs and rectangles, without window and clip planes.
glm::dvec3 reflected_area(const SurfacePoint&, const PlacedLight&);
glm::dvec3 exact_reflected_area(const SurfacePoint&, const PlacedLight&, const ExactOptions&);

}  // namespace strata
