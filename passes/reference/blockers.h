// Light blockers and portals in double (docs/algorithms/lighting.md 2; Kircher, Rendering Technology in Agents of Mayhem, GDC
// 2018): a blocker is a rectangle that stops light, a portal a rectangular hole in the one blocker it names. Nothing is projected
// to the screen: whether a light reaches a point is where the straight way between them passes through each blocker's plane.
//
// A blocker's rectangle is closed and a portal's open: light does not pass between blockers that share an edge, and a portal
// without area opens nothing. A portal cuts no other blocker, however near: a door through both faces of a thick wall is two
// portals (docs/algorithms/lighting.md 0.2, N16).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h
struct Light;  // capture_format/frame/light.h

/// Most blockers and most portals of a light.
inline constexpr std::size_t most_light_blockers = 32, most_light_portals = 32;

/// A blocker in view space: center +- u half_u +- v half_v. Its halves are 1e-5 of the greater and 1e-5 m wider than recorded, so
/// that a rounded position between two that share an edge is inside one of them (docs/algorithms/lighting.md 2.2).
struct PlacedBlocker {
    glm::dvec3 center{0}, normal{0, 0, 1}, u{1, 0, 0}, v{0, 1, 0};
    double half_u = 0, half_v = 0;
    bool one_sided = false;  ///< stops only light from the normal's side, which is cross(u, v) of the record in the world
};

/// A portal in the (u, v) of its blocker, projected onto it along the blocker's normal. Exact where it lies parallel to the
/// blocker or leans around one of its own axes; otherwise its outline would be a parallelogram, and the rectangle over its u side
/// and height stands for it.
struct PlacedPortal {
    glm::dvec2 center{0}, half_extent{0};
    glm::dvec2 turn{1, 0};      ///< cosine and sine from the blocker's u to the portal's
    std::uint32_t blocker = 0;  ///< index into Frame::blockers
};

struct LightBlocker {
    PlacedBlocker shape;
    std::uint32_t blocker = 0;  ///< index into Frame::blockers
    std::uint32_t portals = 0;  ///< bit k: LightBlockers::portals[k] is a hole in it
};
/// What may stand in one light's way, in the light's own order.
struct LightBlockers {
    std::vector<LightBlocker> blockers;
    std::vector<PlacedPortal> portals;
    std::uint32_t dropped = 0;  ///< blockers beyond most_light_blockers
};

/// The blockers a light lists, and of its portals those that open one of them. Portals that share an edge (within 1e-4 m, the
/// same turn) are made 1e-4 m wider: between open sets there would be a line left over. Use it where light starts from anywhere
/// on an emitter, with clear_between().
LightBlockers all_blockers(const Frame&, const Light&);
/// Of those the ones that can stop light from its position or direction: within its range, its plane not through the light
/// (docs/algorithms/lighting.md 2.6), not one-sided away from it. If they are more than most_light_blockers, those of the
/// greatest solid angle seen from the light (the earlier one of equals); they keep their order.
LightBlockers light_blockers(const Frame&, const Light&);

/// Homogeneous in view space: (position, 1), or (towards the light, 0) of directional ones.
glm::dvec4 light_point(const Frame&, const Light&);
/// The point a blocker is asked about in place of one on a surface: max(1 cm, 5e-4 of its depth) along the normal, so that the
/// faces of a wall lie on their own sides of a blocker within it.
glm::dvec3 off_surface(const glm::dvec3& position, const glm::dvec3& normal);

/// Where the way from the light to a point passes through the blocker's plane, in its (u, v); nothing where it does not: the
/// light must be more than 2 cm off the plane (directional: a cosine of 1e-3) and the point more than 5 mm behind it.
std::optional<glm::dvec2> crossing(const PlacedBlocker&, const glm::dvec4& light, const glm::dvec3& position);

/// Whether no blocker stops the light on its way to a position off the surface.
bool lets_through(const LightBlockers&, const glm::dvec4& light, const glm::dvec3& position);
/// The same from a point of an emitter: what the truth of area lights and tubes asks per sample.
bool clear_between(const LightBlockers&, const glm::dvec3& position, const glm::dvec3& emitter);

/// Edges as wide as a light of this radius makes them (docs/algorithms/lighting.md 2.2), and blockers that fade while the light
/// comes through their plane (docs/algorithms/lighting.md 2.6).
struct SoftEdges {
    double radius = 0;  ///< of the source, meters; the tangent of its angular radius when directional; 0 has hard edges
    double fade = 0;    ///< a blocker reaches full strength this far beyond the distance from which it applies; 0 is at once
};
/// 0 dark to 1 lit. Without radius and fade what lets_through() says.
double soft_visibility(const LightBlockers&, const glm::dvec4& light, const glm::dvec3& position, const SoftEdges&);

}  // namespace strata
