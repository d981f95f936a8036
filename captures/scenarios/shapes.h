// Meshes that scenarios share. All are centered, closed shapes face outwards, triangles are counter-clockwise seen from
// outside, and cross(normal, tangent) w points to smaller v.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture_format/frame/mesh.h"

namespace strata::scenario {

/// In the xy plane, facing +z, uv (0, 0) at the upper left.
Mesh quad(glm::vec2 half);
/// Six faces with uv 0..1 each.
Mesh box(glm::vec3 half);
/// `segments` around, half as many from pole to pole; u goes around, v from +y to -y.
Mesh sphere(float radius, std::uint32_t segments);
/// A cylinder along y with a half sphere at each end; `half_length` is that of the cylinder.
Mesh capsule(float radius, float half_length, std::uint32_t segments);

}  // namespace strata::scenario
