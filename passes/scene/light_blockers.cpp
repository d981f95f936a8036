#include "passes/scene/light_blockers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

// Masks of 32 bits name a light's blockers and portals.
constexpr std::size_t most_listed = 32;
// docs/algorithms/lighting.md 2.2: meters by which a light must be off a blocker's plane; of a directional light the cosine.
constexpr double least_height = 0.02, least_cosine = 1e-3;
// docs/algorithms/lighting.md 2.2: how much blockers grow, as a share and in meters, and how much portals that abut, in meters.
constexpr double blocker_growth = 1e-5, portal_growth = 1e-4;
// Portals abut only if their directions are this close.
constexpr double same_turn = 1e-5;

/// A blocker in view space: center +- u half_u +- v half_v.
struct BlockerPlace {
    glm::dvec3 center, normal, u, v;
    double half_u, half_v;
    bool one_sided;
};

/// A blocker of one light.
struct BlockerUse {
    BlockerPlace place;
    std::uint32_t blocker, portals;
    double size = 0;  ///< as the light sees it
};

/// A portal in the (u, v) of its blocker.
struct PortalPlace {
    glm::dvec2 center, half_extent, turn;
    std::uint32_t blocker;
};

BlockerPlace place_of(const Frame& frame, const Blocker& blocker) {
    // The normal is the world's: view space is left-handed where the world is right-handed.
    const glm::dvec3 u = glm::normalize(glm::dvec3(blocker.u)), n = glm::normalize(glm::cross(u, glm::dvec3(blocker.v)));
    const glm::dvec3 view_u = frame.view.to_view * u, view_n = frame.view.to_view * n;
    const double half_u = blocker.half_u, half_v = blocker.half_v;
    const bool has_area = half_u > 0 && half_v > 0;  // what has none stops nothing
    const double growth = has_area ? blocker_growth * std::max(half_u, half_v) + blocker_growth : -1 - std::max(half_u, half_v);
    return {.center = in_view_space(frame.view, blocker.center),
            .normal = view_n,
            .u = view_u,
            .v = glm::cross(view_n, view_u),
            .half_u = half_u + growth,
            .half_v = half_v + growth,
            .one_sided = blocker.one_sided};
}

/// Projects a portal onto its blocker along the blocker's normal. If the outline becomes a parallelogram, the rectangle over its
/// u side with the same height stands for it.
PortalPlace place_of(const Frame& frame, const Portal& portal, const BlockerPlace& blocker) {
    const auto flat = [&](const glm::dvec3& a) { return glm::dvec2(glm::dot(a, blocker.u), glm::dot(a, blocker.v)); };
    const glm::dvec2 u = flat(frame.view.to_view * glm::dvec3(portal.u)), v = flat(frame.view.to_view * glm::dvec3(portal.v));
    const double width = glm::length(u);
    const glm::dvec2 turn = width > 0 ? u / width : glm::dvec2(1, 0);
    return {.center = flat(in_view_space(frame.view, portal.center) - blocker.center),
            .half_extent = {double(portal.half_u) * width, double(portal.half_v) * std::abs(turn.x * v.y - turn.y * v.x)},
            .turn = turn,
            .blocker = portal.blocker};
}

/// Homogeneous: a position, or with w = 0 the direction towards a directional light.
glm::dvec4 place_of(const Frame& frame, const Light& light) {
    if (!has_range(light.type)) return {-(frame.view.to_view * glm::dvec3(light.direction)), 0};
    return {in_view_space(frame.view, light.position), 1};
}

/// Distance of the light from the blocker's plane, positive on the normal's side; of a directional light the cosine.
double height_over(const BlockerPlace& blocker, const glm::dvec4& light) {
    return glm::dot(blocker.normal, glm::dvec3(light) - blocker.center * light.w);
}

double distance_from(const BlockerPlace& blocker, const glm::dvec3& point) {
    const glm::dvec3 offset = point - blocker.center;
    const glm::dvec2 flat(glm::dot(offset, blocker.u), glm::dot(offset, blocker.v));
    const glm::dvec2 beside = glm::max(glm::abs(flat) - glm::dvec2(blocker.half_u, blocker.half_v), 0.0);
    return std::hypot(beside.x, beside.y, glm::dot(offset, blocker.normal));
}

bool can_stop(const BlockerPlace& blocker, const Light& light, const glm::dvec4& from) {
    const double height = height_over(blocker, from), least = from.w > 0 ? least_height : least_cosine;
    if (std::abs(height) <= least || (blocker.one_sided && height < 0)) return false;
    const double reach = double(light.range) + double(light.source_radius) + glm::length(glm::dvec2(light.half_extent));
    return from.w == 0 || distance_from(blocker, glm::dvec3(from)) < reach;
}

/// Solid angle of a triangle seen from the origin (van Oosterom and Strackee 1983).
double triangle_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), below);
}

/// Solid angle seen from a light at a position; of a directional light the area that faces it.
double size_seen(const BlockerPlace& blocker, const glm::dvec4& light) {
    if (light.w == 0) return 4 * blocker.half_u * blocker.half_v * std::abs(height_over(blocker, light));
    const glm::dvec3 u = blocker.u * blocker.half_u, v = blocker.v * blocker.half_v;
    std::array<glm::dvec3, 4> q = {blocker.center - u - v, blocker.center + u - v, blocker.center + u + v,
                                   blocker.center - u + v};
    for (glm::dvec3& corner : q) corner -= glm::dvec3(light);
    return triangle_angle(q[0], q[1], q[2]) + triangle_angle(q[0], q[2], q[3]);
}

/// The blockers that can stop the light. Of too many the largest stay, in the light's order.
std::vector<BlockerUse> blockers_of(const Frame& frame, const Light& light) {
    const glm::dvec4 from = place_of(frame, light);
    std::vector<BlockerUse> uses;
    for (const std::uint32_t index : light.blockers) {
        const Blocker& blocker = frame.blockers[index];
        const BlockerPlace place = place_of(frame, blocker);
        if (blocker.half_u > 0 && blocker.half_v > 0 && can_stop(place, light, from))
            uses.push_back({.place = place, .blocker = index, .portals = 0, .size = size_seen(place, from)});
    }
    std::vector<std::size_t> order(uses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return uses[a].size > uses[b].size; });
    order.resize(std::min(order.size(), most_listed));
    std::ranges::sort(order);
    std::vector<BlockerUse> kept;
    for (const std::size_t place : order) kept.push_back(uses[place]);
    return kept;
}

/// From the axes of the blocker to those of the portal.
glm::dvec2 turned(const PortalPlace& portal, const glm::dvec2& d) {
    return {portal.turn.x * d.x + portal.turn.y * d.y, portal.turn.x * d.y - portal.turn.y * d.x};
}

/// Whether the rectangles have area in common: no axis of either separates them.
bool opens(const PortalPlace& portal, const BlockerPlace& blocker) {
    const glm::dvec2 whole(blocker.half_u, blocker.half_v), turn = glm::abs(portal.turn);
    const auto extent = [&](const glm::dvec2& half) {  // the same in either direction: the absolute turn is symmetric
        return glm::dvec2(turn.x * half.x + turn.y * half.y, turn.y * half.x + turn.x * half.y);
    };
    const glm::dvec2 own = glm::abs(turned(portal, portal.center));
    return portal.half_extent.x > 0 && portal.half_extent.y > 0 &&
           glm::all(glm::lessThan(glm::abs(portal.center), whole + extent(portal.half_extent))) &&
           glm::all(glm::lessThan(own, portal.half_extent + extent(whole)));
}

/// Whether two portals of one blocker share an edge, or part of one.
bool abut(const PortalPlace& a, const PortalPlace& b) {
    if (std::min({a.half_extent.x, a.half_extent.y, b.half_extent.x, b.half_extent.y}) <= 0) return false;
    if (a.blocker != b.blocker || glm::length(a.turn - b.turn) > same_turn) return false;
    const glm::dvec2 gap = glm::abs(turned(a, b.center - a.center)) - a.half_extent - b.half_extent;
    return std::max(gap.x, gap.y) <= portal_growth && std::max(gap.x, gap.y) >= -portal_growth && std::min(gap.x, gap.y) < 0;
}

void join(std::vector<PortalPlace>& portals) {
    std::vector<bool> grows(portals.size());
    for (std::size_t i = 0; i < portals.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (abut(portals[i], portals[k])) grows[i] = grows[k] = true;
    for (std::size_t i = 0; i < portals.size(); ++i)
        if (grows[i]) portals[i].half_extent += portal_growth;
}

/// The portals of a light that open one of its blockers, whose bits are set in `uses`.
std::vector<PortalPlace> cut_portals(const Frame& frame, const Light& light, std::vector<BlockerUse>& uses) {
    std::vector<PortalPlace> portals;
    for (const std::uint32_t index : light.portals) {
        const Portal& portal = frame.portals[index];
        const auto is_its = [&](const BlockerUse& use) { return use.blocker == portal.blocker; };
        const auto first = std::ranges::find_if(uses, is_its);
        if (first == uses.end() || portals.size() == most_listed) continue;
        const PortalPlace place = place_of(frame, portal, first->place);
        if (!opens(place, first->place)) continue;
        for (BlockerUse& use : uses)
            if (is_its(use)) use.portals |= 1u << portals.size();
        portals.push_back(place);
    }
    join(portals);
    return portals;
}

BlockerPortalRecord record(const PortalPlace& place) {
    return {
        .center = glm::vec2(place.center),
        .half_extent = glm::vec2(place.half_extent),
        .turn = glm::vec2(place.turn),
        .blocker = place.blocker,
    };
}

}  // namespace

std::vector<BlockerRecord> blocker_records(const Frame& frame) {
    std::vector<BlockerRecord> records;
    for (const Blocker& blocker : frame.blockers) {
        const BlockerPlace place = place_of(frame, blocker);
        records.push_back({
            .normal = glm::vec3(place.normal),
            .half_u = float(place.half_u),
            .center = glm::vec3(place.center),
            .half_v = float(place.half_v),
            .u = glm::vec3(place.u),
            .one_sided = place.one_sided ? 1u : 0u,
        });
    }
    return records;
}

std::vector<BlockerPortalRecord> portal_records(const Frame& frame) {
    std::vector<PortalPlace> portals;
    for (const Portal& portal : frame.portals)
        portals.push_back(place_of(frame, portal, place_of(frame, frame.blockers[portal.blocker])));
    join(portals);
    std::ranges::stable_sort(portals, {}, &PortalPlace::blocker);
    std::vector<BlockerPortalRecord> records;
    for (const PortalPlace& place : portals) records.push_back(record(place));
    return records;
}

LightBlockerRecords light_blocker_records(const Frame& frame, const Light& light) {
    std::vector<BlockerUse> uses = blockers_of(frame, light);
    LightBlockerRecords records;
    for (const PortalPlace& place : cut_portals(frame, light, uses)) records.portals.push_back(record(place));
    for (const BlockerUse& use : uses) records.blockers.push_back({use.blocker, use.portals});
    return records;
}

}  // namespace strata
