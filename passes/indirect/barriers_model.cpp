#include "passes/indirect/barriers_model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"

namespace strata::indirect::in_double {
namespace {

// docs/algorithms/lighting.md 5.8: meters within which a point is on a plane, and where in the world it belongs to then.
constexpr double on_plane = 1e-3;
constexpr glm::dvec3 side_of_plane(1, 0.37, 0.14);

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

}  // namespace

std::vector<Barrier> barriers(const Frame& frame) {
    std::vector<Barrier> result;
    for (std::uint32_t i = 0; i < frame.blockers.size(); ++i) {
        const Blocker& blocker = frame.blockers[i];
        if (blocker.half_u <= 0 || blocker.half_v <= 0) continue;
        Barrier barrier;
        barrier.center = blocker.center;
        barrier.u = glm::normalize(glm::dvec3(blocker.u));
        const glm::dvec3 recorded(blocker.v);
        barrier.v = glm::normalize(recorded - barrier.u * glm::dot(barrier.u, recorded));
        barrier.normal = glm::cross(barrier.u, barrier.v);
        barrier.half_extent = {blocker.half_u, blocker.half_v};
        for (const Portal& portal : frame.portals)
            if (portal.blocker == i) barrier.holes.push_back(hole_in(barrier, portal));
        result.push_back(barrier);
    }
    return result;
}

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
