// What lights send towards a direction, as reflective shadow maps take it, in double: every light that is not directional counts
// as a point with a radiant intensity (docs/algorithms/lighting.md 0.3, 0.4). Pictures that lights throw are left out.
#pragma once

#include <glm/glm.hpp>

namespace strata {

struct Light;  // capture_format/frame/light.h

}  // namespace strata

namespace strata::indirect::in_double {

/// A light's directions in world space, unit and perpendicular.
struct LightAxes {
    glm::dvec3 along{0, 0, 1}, u{1, 0, 0}, v{0, 1, 0};
};
/// Of a spot: axis_u turned to be perpendicular to the direction. Where it is parallel, as round spots may have it:
/// axes_around().
LightAxes light_axes(const Light&);
/// Of a direction alone: u is horizontal; of an upright direction, perpendicular to +x.
LightAxes axes_around(const glm::vec3& direction);

/// W/sr along a unit direction, before the window of the light's range. Negative components of the intensity count as 0.
glm::dvec3 radiant_intensity(const Light&, const glm::dvec3& direction);

}  // namespace strata::indirect::in_double
