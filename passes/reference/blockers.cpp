// Written from docs/algorithms/lighting.md 0.2, 2.2 and 2.6, with the point of crossing in the open; shaders compare without
// division.
#include "passes/reference/blockers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "passes/reference/shade.h"

namespace strata {
namespace {

// docs/algorithms/lighting.md 2.2: metres a point must lie behind a plane (d_P), and a light before it (d_L; of directional
// lights a cosine). off_surface() moves a point by 1 cm; with a d_P of as much, the far face of a wall would lie on the threshold
// and be lit through its own blocker. Half of it leaves 5 mm to either side.
constexpr double point_behind = 0.005, light_before = 0.02, direction_before = 1e-3;
// docs/algorithms/lighting.md 2.2, what blockers grow by: as a share and in metres. Portals that abut grow by `joined` metres.
constexpr double grown = 1e-5, joined = 1e-4;
constexpr double nearest_offset = 0.01, offset_per_metre = 5e-4;

double light_threshold(const glm::dvec4& light) { return light.w > 0 ? light_before : direction_before; }

glm::dvec3 v_of(const PlacedBlocker& blocker) { return glm::cross(blocker.normal, blocker.u); }

/// Distance of the light from the blocker's plane, on the normal's side; the cosine when directional.
double height(const PlacedBlocker& blocker, const glm::dvec4& light) {
    return glm::dot(blocker.normal, glm::dvec3(light) - blocker.center * light.w);
}

std::array<glm::dvec3, 4> corners(const PlacedBlocker& blocker) {
    const glm::dvec3 u = blocker.u * blocker.half_u, v = v_of(blocker) * blocker.half_v;
    return {blocker.center - u - v, blocker.center + u - v, blocker.center + u + v, blocker.center - u + v};
}

/// Of the triangle seen from the origin (van Oosterom and Strackee 1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), below);
}

/// What a directional light sees is the area as it faces it.
double seen_from(const PlacedBlocker& blocker, const glm::dvec4& light) {
    if (light.w == 0) return 4 * blocker.half_u * blocker.half_v * std::abs(height(blocker, light));
    std::array<glm::dvec3, 4> q = corners(blocker);
    for (glm::dvec3& corner : q) corner -= glm::dvec3(light);
    return solid_angle(q[0], q[1], q[2]) + solid_angle(q[0], q[2], q[3]);
}

double distance_to(const PlacedBlocker& blocker, const glm::dvec3& point) {
    const glm::dvec3 offset = point - blocker.center;
    const glm::dvec2 flat(glm::dot(offset, blocker.u), glm::dot(offset, v_of(blocker)));
    const glm::dvec2 beside = glm::max(glm::abs(flat) - glm::dvec2(blocker.half_u, blocker.half_v), 0.0);
    return std::hypot(beside.x, beside.y, glm::dot(offset, blocker.normal));
}

bool can_stop(const PlacedBlocker& blocker, const Light& light, const glm::dvec4& from) {
    const double h = height(blocker, from);
    if (std::abs(h) <= light_threshold(from) || (blocker.one_sided && h < 0)) return false;
    const double reach = double(light.range) + double(light.source_radius) + glm::length(glm::dvec2(light.half_extent));
    return from.w == 0 || distance_to(blocker, glm::dvec3(from)) < reach;
}

/// From the axes of the blocker to those of the portal.
glm::dvec2 turned(const PlacedPortal& portal, const glm::dvec2& d) {
    return {portal.turn.x * d.x + portal.turn.y * d.y, portal.turn.x * d.y - portal.turn.y * d.x};
}

/// Whether the rectangles have area in common: no axis of either separates them.
bool opens(const PlacedPortal& portal, const PlacedBlocker& blocker) {
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
bool abut(const PlacedPortal& a, const PlacedPortal& b) {
    if (a.blocker != b.blocker || glm::length(a.turn - b.turn) > grown) return false;
    const glm::dvec2 gap = glm::abs(turned(a, b.center - a.center)) - a.half_extent - b.half_extent;
    return std::max(gap.x, gap.y) <= joined && std::max(gap.x, gap.y) >= -joined && std::min(gap.x, gap.y) < 0;
}

void join(std::vector<PlacedPortal>& portals) {
    std::vector<bool> grows(portals.size());
    for (std::size_t i = 0; i < portals.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (abut(portals[i], portals[k])) grows[i] = grows[k] = true;
    for (std::size_t i = 0; i < portals.size(); ++i)
        if (grows[i]) portals[i].half_extent += joined;
}

void add_portals(const Frame& frame, const Light& light, LightBlockers& result) {
    for (const std::uint32_t index : light.portals) {
        const Portal& portal = frame.portals[index];
        const auto its = [&](const LightBlocker& use) { return use.blocker == portal.blocker; };
        const auto first = std::ranges::find_if(result.blockers, its);
        if (first == result.blockers.end() || result.portals.size() == most_light_portals) continue;
        const PlacedPortal placed = placed_portal(frame, portal, first->shape);
        if (!opens(placed, first->shape)) continue;
        const std::uint32_t bit = 1u << result.portals.size();
        for (LightBlocker& use : result.blockers)
            if (its(use)) use.portals |= bit;
        result.portals.push_back(placed);
    }
    join(result.portals);
}

std::vector<LightBlocker> listed_blockers(const Frame& frame, const Light& light) {
    std::vector<LightBlocker> result;
    for (const std::uint32_t index : light.blockers) {
        const Blocker& blocker = frame.blockers[index];
        if (blocker.half_u > 0 && blocker.half_v > 0)
            result.push_back({.shape = placed_blocker(frame, blocker), .blocker = index, .portals = 0});
    }
    return result;
}

/// The places of the largest, in order.
std::vector<std::size_t> largest(const std::vector<double>& sizes) {
    std::vector<std::size_t> places(sizes.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::ranges::stable_sort(places, [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    places.resize(std::min(places.size(), most_light_blockers));
    std::ranges::sort(places);
    return places;
}

bool is_open(const PlacedPortal& portal, const glm::dvec2& at) {
    const glm::dvec2 d = glm::abs(turned(portal, at - portal.center));
    return d.x < portal.half_extent.x && d.y < portal.half_extent.y;
}

/// Of a rectangle around 0 with edges of half width q.
double coverage(const glm::dvec2& at, const glm::dvec2& half, double q) {
    double product = 1;
    for (int i = 0; i < 2; ++i) {
        const auto edge = [&](double x) { return glm::smoothstep(-1.0, 1.0, x / q); };
        product *= edge(at[i] + half[i]) - edge(at[i] - half[i]);
    }
    return product;
}

/// How much of the light a blocker takes at its full strength.
double taken(const LightBlockers& all, const LightBlocker& use, const glm::dvec2& at, double q) {
    const glm::dvec2 whole(use.shape.half_u, use.shape.half_v);
    if (q <= 0 && (std::abs(at.x) > whole.x || std::abs(at.y) > whole.y)) return 0;
    double share = q > 0 ? coverage(at, whole, q) : 1;
    for (std::size_t k = 0; k < all.portals.size(); ++k) {
        if ((use.portals >> k & 1u) == 0) continue;
        const PlacedPortal& portal = all.portals[k];
        share -= q > 0 ? coverage(turned(portal, at - portal.center), portal.half_extent, q) : double(is_open(portal, at));
    }
    return std::max(share, 0.0);
}

}  // namespace

PlacedBlocker placed_blocker(const Frame& frame, const Blocker& blocker) {
    // The normal is the world's: view space is left-handed where the world is right-handed.
    const glm::dvec3 u = glm::normalize(glm::dvec3(blocker.u)), n = glm::normalize(glm::cross(u, glm::dvec3(blocker.v)));
    const double half_u = blocker.half_u, half_v = blocker.half_v, growth = grown * std::max(half_u, half_v) + grown;
    return {.center = to_view(frame, blocker.center),
            .normal = frame.view.to_view * n,
            .u = frame.view.to_view * u,
            .half_u = half_u + growth,
            .half_v = half_v + growth,
            .one_sided = blocker.one_sided};
}

PlacedPortal placed_portal(const Frame& frame, const Portal& portal, const PlacedBlocker& blocker) {
    const glm::dvec3 v_axis = v_of(blocker);
    const auto flat = [&](const glm::dvec3& a) { return glm::dvec2(glm::dot(a, blocker.u), glm::dot(a, v_axis)); };
    const glm::dvec2 u = flat(frame.view.to_view * glm::dvec3(portal.u)), v = flat(frame.view.to_view * glm::dvec3(portal.v));
    const double width = glm::length(u);
    const glm::dvec2 turn = width > 0 ? u / width : glm::dvec2(1, 0);
    return {.center = flat(to_view(frame, portal.center) - blocker.center),
            .half_extent = {double(portal.half_u) * width, double(portal.half_v) * std::abs(turn.x * v.y - turn.y * v.x)},
            .turn = turn,
            .blocker = portal.blocker};
}

LightBlockers all_blockers(const Frame& frame, const Light& light) {
    LightBlockers result{.blockers = listed_blockers(frame, light), .portals = {}};
    add_portals(frame, light, result);
    return result;
}

LightBlockers light_blockers(const Frame& frame, const Light& light) {
    const glm::dvec4 from = light_point(frame, light);
    std::vector<LightBlocker> near = listed_blockers(frame, light);
    std::erase_if(near, [&](const LightBlocker& use) { return !can_stop(use.shape, light, from); });
    std::vector<double> sizes;
    for (const LightBlocker& use : near) sizes.push_back(seen_from(use.shape, from));
    LightBlockers result;
    for (const std::size_t place : largest(sizes)) result.blockers.push_back(near[place]);
    result.dropped = static_cast<std::uint32_t>(near.size() - result.blockers.size());
    add_portals(frame, light, result);
    return result;
}

glm::dvec4 light_point(const Frame& frame, const Light& light) {
    if (light.type == LightType::directional) return {-(frame.view.to_view * glm::dvec3(light.direction)), 0};
    return {to_view(frame, light.position), 1};
}

glm::dvec3 off_surface(const glm::dvec3& position, const glm::dvec3& normal) {
    return position + normal * std::max(nearest_offset, offset_per_metre * position.z);
}

std::optional<glm::dvec2> crossing(const PlacedBlocker& blocker, const glm::dvec4& light, const glm::dvec3& position) {
    const double h = height(blocker, light), side = h < 0 ? -1 : 1;
    const double before = side * h, behind = -side * glm::dot(blocker.normal, position - blocker.center);
    if (before <= light_threshold(light) || behind <= point_behind || (blocker.one_sided && h < 0)) return std::nullopt;
    const glm::dvec3 way = glm::dvec3(light) - position * light.w;
    const glm::dvec3 at = position + way * (behind / (before + behind * light.w)) - blocker.center;
    return glm::dvec2(glm::dot(blocker.u, at), glm::dot(v_of(blocker), at));
}

bool lets_through(const LightBlockers& all, const glm::dvec4& light, const glm::dvec3& position) {
    return std::ranges::none_of(all.blockers, [&](const LightBlocker& use) {
        const auto at = crossing(use.shape, light, position);
        return at && taken(all, use, *at, 0) > 0;
    });
}

bool clear_between(const LightBlockers& all, const glm::dvec3& position, const glm::dvec3& emitter) {
    return lets_through(all, glm::dvec4(emitter, 1), position);
}

double soft_visibility(const LightBlockers& all, const glm::dvec4& light, const glm::dvec3& position, const SoftEdges& edges) {
    double visible = 1;
    for (const LightBlocker& use : all.blockers) {
        const auto at = crossing(use.shape, light, position);
        if (!at) continue;
        const double before = std::abs(height(use.shape, light)), begin = light_threshold(light);
        const double behind = std::abs(glm::dot(use.shape.normal, position - use.shape.center));
        const double strength = edges.fade > 0 ? glm::smoothstep(begin, begin + edges.fade, before) : 1;
        visible *= 1 - strength * taken(all, use, *at, edges.radius * behind / (before + behind * light.w));
    }
    return visible;
}

}  // namespace strata
