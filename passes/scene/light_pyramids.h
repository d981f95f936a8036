// Where the rays of a light go that maps are drawn along: shadow maps and reflective ones.
#pragma once

#include <numbers>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Light;  // capture_format/frame/light.h
struct View;   // capture_format/view.h

/// Radians. Half angle from which a perspective map is useless: tan 85 degrees is 11.4.
inline constexpr double widest_half_angle = 85 * std::numbers::pi / 180;

/// In view space: the axis of a pyramid of rays, unit, what lies beside it, and the slopes of its sides along u and v.
struct LightPyramid {
    glm::dvec3 along, u;
    glm::dvec2 slopes;
    glm::dvec3 v() const { return glm::cross(along, u); }
};

/// The slopes of the sides of a light's pyramids; it has a position.
glm::dvec2 pyramid_slopes(const Light&);
/// One of a spot; of any other light that has a position six, the faces of a cube that stands along the world's axes: +x, -x, +y,
/// -y, +z, -z.
std::vector<LightPyramid> light_pyramids(const View&, const Light&);

/// Of parallel light, in the world: fixed by its direction alone, so that texels stay where they are when the camera moves.
struct ParallelAxes {
    glm::dvec3 along, u, v;
};
ParallelAxes parallel_axes(const glm::dvec3& direction);

}  // namespace strata
