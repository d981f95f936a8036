// Blockers and portals as light propagation volumes see them, in double: a segment is blocked where it crosses the rectangle of a
// blocker outside that blocker's portals. Unlike blockers of single lights (passes/reference/blockers.h) there are no distances
// from the plane below which nothing is blocked: a cell's middle on the plane would see both sides (docs/algorithms/lighting.md
// 5.8). Every blocker stops light from both sides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::indirect::in_double {

/// A portal in the plane of its blocker. The set is open: a segment through its edge is blocked.
struct Hole {
    glm::dvec2 center{0}, half_extent{0};
    glm::dvec2 turn{1, 0};  ///< cosine and sine of the angle from the blocker's u to the portal's
};

/// A blocker in world space. The set is closed.
struct Barrier {
    glm::dvec3 center{0}, normal{0, 0, 1}, u{1, 0, 0}, v{0, 1, 0};
    glm::dvec2 half_extent{0};
    std::vector<Hole> holes;
};

/// All blockers of a frame that have an area, each with its own portals.
std::vector<Barrier> barriers(const Frame&);
/// A blocker with an area; of its portals those among `portals`.
Barrier barrier(const Frame&, std::uint32_t blocker, std::span<const std::uint32_t> portals);

/// Where ways of bounced light begin at a surface: 2 cm along its normal. The side of this place is the surface's side of every
/// blocker, whether a light injects there, a surfel reflects or a sample reads cells (docs/algorithms/lighting.md 5.8).
glm::dvec3 way_begin(const glm::dvec3& position, const glm::dvec3& normal);

struct Segment {
    glm::dvec3 from{0}, to{0};
};

enum class Meeting { misses, passes_hole, is_stopped };

/// Rectangles are `slack` meters wider than recorded, so that nothing passes between two that share an edge.
Meeting meets(const Barrier&, const Segment&, double slack);
bool is_blocked(std::span<const Barrier>, const Segment&, double slack);

/// Width of the slack in a grid with cells of this size: 1e-6 of it (docs/algorithms/lighting.md 5.6).
constexpr double slack_of(double cell_size) { return 1e-6 * cell_size; }

}  // namespace strata::indirect::in_double
