#include "passes/indirect/barriers_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"

namespace strata::indirect::in_double {
namespace {

// docs/algorithms/lighting.md 5.8: meters within which a point is on a plane, and where in the world it belongs to then.
constexpr double on_plane = 1e-3;
constexpr glm::dvec3 side_of_plane(1, 0.37, 0.14);
// Meters along the normal of a surface at which its ways begin: more than the 15 mm behind a blocker where direct light ends
// (docs/algorithms/lighting.md 2.2), so that no face is lit on one side and bounces light on the other.
constexpr double before_surface = 0.02;

/// The portal projected onto the blocker along its normal: the rectangle over the projected u side with the projected height.
Hole hole_in(const Barrier& barrier, const Portal& portal) {
    const auto flat = [&](const glm::dvec3& way) { return glm::dvec2(glm::dot(way, barrier.u), glm::dot(way, barrier.v)); };
    const glm::dvec2 along = flat(glm::dvec3(portal.u)) * double(portal.half_u);
    const glm::dvec2 across = flat(glm::dvec3(portal.v)) * double(portal.half_v);
    const double half_width = glm::length(along);
    if (half_width == 0) return {};
    const double half_height = glm::abs(along.x * across.y - along.y * across.x) / half_width;
    return {.center = flat(portal.center - barrier.center), .half_extent = {half_width, half_height}, .turn = along / half_width};
}

bool is_within(const Hole& hole, const glm::dvec2& place) {
    const glm::dvec2 d = place - hole.center;
    const glm::dvec2 turned(hole.turn.x * d.x + hole.turn.y * d.y, hole.turn.x * d.y - hole.turn.y * d.x);
    return glm::all(glm::lessThan(glm::abs(turned), hole.half_extent));
}

Barrier closed(const Blocker& blocker) {
    Barrier barrier;
    barrier.center = blocker.center;
    barrier.u = glm::normalize(glm::dvec3(blocker.u));
    const glm::dvec3 recorded(blocker.v);
    barrier.v = glm::normalize(recorded - barrier.u * glm::dot(barrier.u, recorded));
    barrier.normal = glm::cross(barrier.u, barrier.v);
    barrier.half_extent = {blocker.half_u, blocker.half_v};
    return barrier;
}

}  // namespace

Barrier barrier(const Frame& frame, std::uint32_t blocker, std::span<const std::uint32_t> portals) {
    Barrier result = closed(frame.blockers[blocker]);
    for (const std::uint32_t portal : portals)
        if (frame.portals[portal].blocker == blocker) result.holes.push_back(hole_in(result, frame.portals[portal]));
    return result;
}

std::vector<Barrier> barriers(const Frame& frame) {
    std::vector<std::uint32_t> portals(frame.portals.size());
    std::iota(portals.begin(), portals.end(), 0u);
    std::vector<Barrier> result;
    for (std::uint32_t i = 0; i < frame.blockers.size(); ++i)
        if (frame.blockers[i].half_u > 0 && frame.blockers[i].half_v > 0) result.push_back(barrier(frame, i, portals));
    return result;
}

glm::dvec3 way_begin(const glm::dvec3& position, const glm::dvec3& normal) { return position + before_surface * normal; }

Meeting meets(const Barrier& barrier, const Segment& segment, double slack) {
    const double from = glm::dot(barrier.normal, segment.from - barrier.center);
    const double to = glm::dot(barrier.normal, segment.to - barrier.center);
    const double begin = glm::dot(barrier.normal, side_of_plane) > 0 ? -on_plane : on_plane;
    if ((from >= begin) == (to >= begin)) return Meeting::misses;
    const double share = std::abs(from) / (std::abs(from) + std::abs(to));
    const glm::dvec3 at = glm::mix(segment.from, segment.to, share) - barrier.center;
    const glm::dvec2 place(glm::dot(at, barrier.u), glm::dot(at, barrier.v));
    if (glm::any(glm::greaterThan(glm::abs(place), barrier.half_extent + slack))) return Meeting::misses;
    const bool is_open = std::ranges::any_of(barrier.holes, [&](const Hole& hole) { return is_within(hole, place); });
    return is_open ? Meeting::passes_hole : Meeting::is_stopped;
}

bool is_blocked(std::span<const Barrier> all, const Segment& segment, double slack) {
    return std::ranges::any_of(all, [&](const Barrier& b) { return meets(b, segment, slack) == Meeting::is_stopped; });
}

}  // namespace strata::indirect::in_double
