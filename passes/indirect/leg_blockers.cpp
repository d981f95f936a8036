#include "passes/indirect/leg_blockers.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"

namespace strata::indirect {
namespace {

bool is_open(const PlacedPortal& portal, const glm::dvec2& at) {
    const glm::dvec2 d = at - portal.center;
    const glm::dvec2 turned(portal.turn.x * d.x + portal.turn.y * d.y, portal.turn.x * d.y - portal.turn.y * d.x);
    return std::abs(turned.x) < portal.half_extent.x && std::abs(turned.y) < portal.half_extent.y;
}

}  // namespace

// Placing is asked of lights that list one blocker each: a light lists 32 portals at most, a frame has any number.
LegBlockers::LegBlockers(const Frame& frame) {
    for (std::uint32_t i = 0; i < frame.blockers.size(); ++i) {
        std::vector<Light> alone(1);
        for (std::uint32_t k = 0; k < frame.portals.size(); ++k) {
            if (frame.portals[k].blocker != i) continue;
            if (alone.back().portals.size() == most_light_portals) alone.emplace_back();
            alone.back().portals.push_back(k);
        }
        BlockerWithPortals placed;
        for (Light& light : alone) {
            light.blockers = {i};
            const LightBlockers part = all_blockers(frame, light);
            if (part.blockers.empty()) break;
            placed.shape = part.blockers.front().shape;
            placed.portals.insert(placed.portals.end(), part.portals.begin(), part.portals.end());
            if (&light == &alone.back()) blockers_.push_back(std::move(placed));
        }
    }
}

bool LegBlockers::stops(const BlockerWithPortals& blocker, const glm::dvec3& from, const glm::dvec3& to) {
    const PlacedBlocker& shape = blocker.shape;
    const double a = glm::dot(shape.normal, from - shape.center), b = glm::dot(shape.normal, to - shape.center);
    // A point on the plane belongs to the normal's side.
    if ((a >= 0) == (b >= 0) || (shape.one_sided && a < 0)) return false;
    const glm::dvec3 crossing = from + (to - from) * (a / (a - b)) - shape.center;
    const glm::dvec2 at(glm::dot(shape.u, crossing), glm::dot(shape.v, crossing));
    if (std::abs(at.x) > shape.half_u || std::abs(at.y) > shape.half_v) return false;
    return std::ranges::none_of(blocker.portals, [&](const PlacedPortal& portal) { return is_open(portal, at); });
}

bool LegBlockers::let_through(const glm::dvec3& from, const glm::dvec3& to) const {
    return std::ranges::none_of(blockers_, [&](const BlockerWithPortals& blocker) { return stops(blocker, from, to); });
}

}  // namespace strata::indirect
