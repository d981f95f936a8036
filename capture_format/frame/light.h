// Lights of a frame, and what stops their light.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/shadow_use.h"

namespace strata {

enum class LightType : std::uint32_t { omni, round_spot, square_spot, tube, sphere, disc, rectangle, directional };

/// How a light ends, with x = distance / range: by (1 - x^4)^2, as in engines (Karis, Real Shading in Unreal Engine 4, 2013), or
/// by 1 - x^4, as KHR_lights_punctual of glTF recommends.
enum class RangeWindow : std::uint32_t { squared_quartic, quartic };

/// Keeps what lies on the side dot(normal, p) + distance >= 0, world space.
struct ClipPlane {
    glm::dvec3 normal{0, 1, 0};
    double distance = 0;
};

/// Any light. Intensity is W/sr for points and spots, irradiance for directional, and for tubes, spheres, discs and rectangles
/// the radiance of their surface; negative is a "dark". A tube is a capsule: a cylinder along axis_u with half spheres on its
/// ends. Discs and rectangles shine to the front only. A picture's u grows along axis_u, its v against cross(direction, axis_u)
/// of view space: one that a spot throws is upright for who stands behind the spot with axis_u to the right.
struct Light {
    std::string name;
    LightType type = LightType::omni;
    glm::dvec3 position{0};
    glm::vec3 direction{0, -1, 0};  ///< where it shines, unit
    glm::vec3 axis_u{1, 0, 0};      ///< unit, perpendicular to direction
    glm::vec3 intensity{1};
    float range = 10;  ///< from position: the window is exactly 0 from here on
    RangeWindow window = RangeWindow::squared_quartic;
    float source_radius = 0;                       ///< sphere, disc, tube
    glm::vec2 half_extent{0};                      ///< rectangle half sizes; tube half length in x
    float inner_angle = 0.5f, outer_angle = 0.7f;  ///< half angles; a square spot uses outer for u and inner for v
    std::uint32_t texture = no_index;              ///< projected (spots) or emitted (rectangle)
    ShadowUse shadow;
    std::vector<ClipPlane> clip_planes;   ///< at most 6
    std::vector<std::uint32_t> blockers;  ///< indices into Frame::blockers, at most 32
    std::vector<std::uint32_t> portals;   ///< indices into Frame::portals, at most 32
};

/// A rectangle that stops light: center +- u * half_u +- v * half_v. One without area stops nothing.
struct Blocker {
    glm::dvec3 center{0};
    glm::vec3 u{1, 0, 0}, v{0, 1, 0};
    float half_u = 1, half_v = 1;
    bool one_sided = false;  ///< stops only light from the side to which cross(u, v) points
};

/// A hole in one blocker, projected onto it along its normal; what lies outside of it opens nothing. A door through both faces of
/// a thick wall is two portals.
struct Portal {
    glm::dvec3 center{0};
    glm::vec3 u{1, 0, 0}, v{0, 1, 0};
    float half_u = 1, half_v = 1;
    std::uint32_t blocker = 0;  ///< index into Frame::blockers
};

}  // namespace strata
