// Written from docs/algorithms/lighting.md 0.2, 2.2 and 2.6: rectangles by their corners, and the point of crossing in the open.
// Shaders compare without division, and passes/scene/light_blockers.cpp derives what they are given.
#include "passes/reference/blockers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

// docs/algorithms/lighting.md 2.2: meters a point must lie behind a plane (d_P), and a light before it (d_L; of directional
// lights a cosine). off_surface() moves a point by 1 cm; with a d_P of as much, the far face of a wall would lie on the threshold
// and be lit through its own blocker. Half of it leaves 5 mm to either side.
constexpr double point_behind = 0.005, light_before = 0.02, direction_before = 1e-3;
// docs/algorithms/lighting.md 2.2, what blockers grow by: as a share and in meters. Portals that abut grow by `joined` meters.
constexpr double grown = 1e-5, joined = 1e-4;
// Portals whose directions are this close have the same turn.
constexpr double same_turn = 1e-5;
// Meters: a portal has no area in common with a blocker where that is thinner. World positions 1000 km away round to 1e-10.
constexpr double thinnest = 1e-9;
constexpr double nearest_offset = 0.01, offset_per_meter = 5e-4;

double light_threshold(const glm::dvec4& light) { return light.w > 0 ? light_before : direction_before; }

/// Distance of the light from the blocker's plane, on the normal's side; the cosine when directional.
double height(const PlacedBlocker& blocker, const glm::dvec4& light) {
    return glm::dot(blocker.normal, glm::dvec3(light) - blocker.center * light.w);
}

/// Around a rectangle: (-, -), (+, -), (+, +), (-, +) along its half edges.
template <typename Vector>
std::array<Vector, 4> corners(const Vector& center, const Vector& u, const Vector& v) {
    return {center - u - v, center + u - v, center + u + v, center - u + v};
}

std::array<glm::dvec3, 4> corners(const PlacedBlocker& blocker) {
    return corners(blocker.center, blocker.u * blocker.half_u, blocker.v * blocker.half_v);
}

std::array<glm::dvec3, 4> corners_in_view(const Frame& frame, const glm::dvec3& center, const glm::dvec3& u,
                                          const glm::dvec3& v) {
    std::array<glm::dvec3, 4> q = corners(center, u, v);
    for (glm::dvec3& corner : q) corner = to_view(frame, corner);
    return q;
}

/// Places the four corners of the grown rectangle and measures it in view space.
PlacedBlocker placed(const Frame& frame, const Blocker& blocker) {
    // A capture's axes are unit and perpendicular but for 2e-3; the recorded v is turned within the plane.
    const glm::dvec3 u = glm::normalize(glm::dvec3(blocker.u)), recorded(blocker.v);
    const glm::dvec3 v = glm::normalize(recorded - u * glm::dot(u, recorded));
    const double half_u = blocker.half_u, half_v = blocker.half_v, growth = grown * std::max(half_u, half_v) + grown;
    const auto q = corners_in_view(frame, blocker.center, u * (half_u + growth), v * (half_v + growth));
    const glm::dvec3 along = q[1] - q[0], across = q[3] - q[0];
    // A mirroring view turns the cross product around.
    const double handedness = glm::determinant(frame.view.to_view) < 0 ? -1 : 1;
    return {.center = (q[0] + q[2]) / 2.0,
            .normal = handedness * glm::normalize(glm::cross(along, across)),
            .u = glm::normalize(along),
            .v = glm::normalize(across),
            .half_u = glm::length(along) / 2,
            .half_v = glm::length(across) / 2,
            .one_sided = blocker.one_sided};
}

/// Projects the four corners onto the blocker.
PlacedPortal placed(const Frame& frame, const Portal& portal, const PlacedBlocker& blocker) {
    const glm::dvec3 u(portal.u), v(portal.v);
    std::array<glm::dvec2, 4> flat;
    std::ranges::transform(corners_in_view(frame, portal.center, u * double(portal.half_u), v * double(portal.half_v)),
                           flat.begin(), [&](const glm::dvec3& corner) {
                               return glm::dvec2(glm::dot(corner - blocker.center, blocker.u),
                                                 glm::dot(corner - blocker.center, blocker.v));
                           });
    const glm::dvec2 base = flat[1] - flat[0], side = flat[3] - flat[0];
    const double width = glm::length(base), area = std::abs(base.x * side.y - base.y * side.x);
    if (width == 0) return {.blocker = portal.blocker};
    return {.center = (flat[0] + flat[2]) / 2.0,
            .half_extent = {width / 2, area / width / 2},
            .turn = base / width,
            .blocker = portal.blocker};
}

/// To the nearest point of the rectangle: the foot of the perpendicular if it is inside, else on one of the edges.
double distance_to(const PlacedBlocker& blocker, const glm::dvec3& point) {
    const std::array<glm::dvec3, 4> q = corners(blocker);
    bool is_above = true;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 edge = q[(i + 1) % 4] - q[i], inwards = q[(i + 2) % 4] - q[(i + 1) % 4], to_point = point - q[i];
        is_above = is_above && glm::dot(to_point, inwards) >= 0;
        const double share = std::clamp(glm::dot(to_point, edge) / glm::dot(edge, edge), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(to_point - share * edge));
    }
    return is_above ? std::abs(height(blocker, glm::dvec4(point, 1))) : nearest;
}

bool can_stop(const PlacedBlocker& blocker, const Light& light, const glm::dvec4& from) {
    const double h = height(blocker, from);
    if (blocker.one_sided && h < 0) return false;
    const double emitter = double(light.source_radius) + glm::length(glm::dvec2(light.half_extent));
    const bool is_in_range = from.w == 0 || distance_to(blocker, glm::dvec3(from)) < double(light.range) + emitter;
    return is_in_range && std::abs(h) > light_threshold(from);
}

/// Solid angle of the rectangle (Khadjavi, JOSA 58, 1968: four arctangents); a directional light sees the area as it faces it.
double seen_from(const PlacedBlocker& blocker, const glm::dvec4& light) {
    const std::array<glm::dvec3, 4> q = corners(blocker);
    if (light.w == 0) return std::abs(glm::dot(glm::cross(q[2] - q[0], q[3] - q[1]), glm::dvec3(light))) / 2;
    const double z = std::abs(height(blocker, light));
    double angle = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 way = q[i] - glm::dvec3(light);
        const double part = std::atan(glm::dot(way, blocker.u) * glm::dot(way, blocker.v) / (z * glm::length(way)));
        angle += i % 2 == 0 ? part : -part;
    }
    return angle;
}

/// From the axes of the blocker to those of the portal.
glm::dvec2 turned(const PlacedPortal& portal, const glm::dvec2& d) {
    return {portal.turn.x * d.x + portal.turn.y * d.y, portal.turn.x * d.y - portal.turn.y * d.x};
}

/// A portal's corners on its blocker, counterclockwise.
std::array<glm::dvec2, 4> outline(const PlacedPortal& portal) {
    const glm::dvec2 across(-portal.turn.y, portal.turn.x);
    return corners(portal.center, portal.turn * portal.half_extent.x, across * portal.half_extent.y);
}

/// What of a convex polygon has no more than `limit` in a direction (Sutherland and Hodgman 1974).
std::vector<glm::dvec2> clipped(const std::vector<glm::dvec2>& polygon, const glm::dvec2& direction, double limit) {
    std::vector<glm::dvec2> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double over_a = glm::dot(direction, a) - limit, over_b = glm::dot(direction, b) - limit;
        if (over_a <= 0) result.push_back(a);
        if (over_a * over_b < 0) result.push_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
    return result;
}

/// Whether the portal and the blocker have area in common.
bool opens(const PlacedPortal& portal, const PlacedBlocker& blocker) {
    const auto q = outline(portal);
    std::vector<glm::dvec2> common(q.begin(), q.end());
    for (const double sign : {-1., 1.}) {
        common = clipped(common, {sign, 0}, blocker.half_u);
        common = clipped(common, {0, sign}, blocker.half_v);
    }
    double area = 0, around = 0;
    for (std::size_t i = 0; i < common.size(); ++i) {
        const glm::dvec2 &a = common[i], &b = common[(i + 1) % common.size()];
        area += (a.x * b.y - a.y * b.x) / 2;
        around += glm::length(b - a);
    }
    return area > thinnest * around;
}

/// Whether an edge of one portal and the facing edge of the other lie together, or parts of them.
bool share_edge(const PlacedPortal& a, const PlacedPortal& b) {
    if (a.blocker != b.blocker || glm::length(a.turn - b.turn) > same_turn) return false;
    const auto qa = outline(a), qb = outline(b);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 edge = qa[(i + 1) % 4] - qa[i], along = glm::normalize(edge), outwards(along.y, -along.x);
        const glm::dvec2 end = qb[(i + 2) % 4] - qa[i], begin = qb[(i + 3) % 4] - qa[i];
        const double common = std::min(glm::length(edge), glm::dot(end, along)) - std::max(0.0, glm::dot(begin, along));
        if (std::abs(glm::dot(end, outwards)) <= joined && common > 0) return true;
    }
    return false;
}

void widen_joined(std::vector<PlacedPortal>& portals) {
    const std::vector<PlacedPortal> before = portals;
    for (std::size_t i = 0; i < portals.size(); ++i)
        for (std::size_t k = 0; k < portals.size(); ++k)
            if (k != i && share_edge(before[i], before[k])) portals[i].half_extent = before[i].half_extent + joined;
}

void add_portals(const Frame& frame, const Light& light, LightBlockers& result) {
    for (const std::uint32_t index : light.portals) {
        const Portal& portal = frame.portals[index];
        std::optional<PlacedPortal> hole;
        for (const LightBlocker& use : result.blockers)
            if (use.blocker == portal.blocker) hole = placed(frame, portal, use.shape);
        const auto bit = static_cast<std::uint32_t>(result.portals.size());
        if (!hole || bit == most_light_portals) continue;
        bool is_hole = false;
        for (LightBlocker& use : result.blockers) {
            if (use.blocker != portal.blocker || !opens(*hole, use.shape)) continue;
            use.portals |= 1u << bit;
            is_hole = true;
        }
        if (is_hole) result.portals.push_back(*hole);
    }
    widen_joined(result.portals);
}

std::vector<LightBlocker> listed_blockers(const Frame& frame, const Light& light) {
    std::vector<LightBlocker> result;
    for (const std::uint32_t index : light.blockers) {
        const Blocker& blocker = frame.blockers[index];
        if (blocker.half_u > 0 && blocker.half_v > 0)
            result.push_back({.shape = placed(frame, blocker), .blocker = index, .portals = 0});
    }
    return result;
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
    for (std::size_t i = 0; i < near.size(); ++i) {
        std::size_t before = 0;  // how many come before it, sorted by size
        for (std::size_t k = 0; k < near.size(); ++k) before += sizes[k] > sizes[i] || (sizes[k] == sizes[i] && k < i) ? 1 : 0;
        if (before < most_light_blockers) result.blockers.push_back(near[i]);
    }
    result.dropped = static_cast<std::uint32_t>(near.size() - result.blockers.size());
    add_portals(frame, light, result);
    return result;
}

glm::dvec4 light_point(const Frame& frame, const Light& light) {
    if (!has_range(light.type)) return {-(frame.view.to_view * glm::dvec3(light.direction)), 0};
    return {to_view(frame, light.position), 1};
}

glm::dvec3 off_surface(const glm::dvec3& position, const glm::dvec3& normal) {
    return position + normal * std::max(nearest_offset, offset_per_meter * position.z);
}

std::optional<glm::dvec2> crossing(const PlacedBlocker& blocker, const glm::dvec4& light, const glm::dvec3& position) {
    const double h = height(blocker, light), side = h < 0 ? -1 : 1;
    const double before = side * h, behind = -side * glm::dot(blocker.normal, position - blocker.center);
    if (before <= light_threshold(light) || behind <= point_behind || (blocker.one_sided && h < 0)) return std::nullopt;
    const glm::dvec3 way = glm::dvec3(light) - position * light.w;
    const glm::dvec3 at = position + way * (behind / (before + behind * light.w)) - blocker.center;
    return glm::dvec2(glm::dot(blocker.u, at), glm::dot(blocker.v, at));
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
