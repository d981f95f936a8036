// Written beside blocker_cells.glsl: change both.
#include "passes/lighting/cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passes/shaders/blockers.shared.h"

namespace strata::lighting {
namespace {

template <typename Real>
using Vec3 = glm::vec<3, Real>;
template <typename Real>
using Vec4 = glm::vec<4, Real>;

/// Left to right, as shaders do it.
template <typename Real>
Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename Real>
Real length(const Vec3<Real>& a) {
    return std::sqrt(dot(a, a));
}

template <typename Real>
struct Rectangle {
    Vec3<Real> center, normal, u, v;  ///< v is not unit: u and v end at the edges
    explicit Rectangle(const BlockerRecord& r)
        : center(r.center),
          normal(r.normal),
          u(Vec3<Real>(r.u) * Real(r.half_u)),
          v(glm::cross(normal, Vec3<Real>(r.u)) * Real(r.half_v)) {}
    /// Counter-clockwise around the normal.
    Vec3<Real> corner(std::uint32_t i) const { return center + (i == 1 || i == 2 ? u : -u) + (i >= 2 ? v : -v); }
};

/// Distance of the light from the plane on the normal's side; 0 where nothing is stopped.
template <typename Real>
Real stopped_height(const BlockerRecord& r, const Vec4<Real>& light) {
    const Real height = dot(Vec3<Real>(r.normal), Vec3<Real>(light) - Vec3<Real>(r.center) * light.w);
    const Real least = Real(light.w > 0 ? light_before_blocker : direction_before_blocker);
    return std::abs(height) > least && (r.one_sided == 0 || height > 0) ? height : Real(0);
}

template <typename Real>
struct Range {
    Real low = std::numeric_limits<Real>::max(), high = std::numeric_limits<Real>::lowest();
};

/// Signed distances of the cell's corners from the plane through `origin`.
template <typename Real>
Range<Real> corner_range(const Cell<Real>& cell, const Vec3<Real>& normal, const Vec3<Real>& origin) {
    Range<Real> range;
    for (const Vec3<Real>& corner : cell.corners) {
        const Real d = dot(normal, corner - origin);
        range = {std::min(range.low, d), std::max(range.high, d)};
    }
    return range;
}

template <typename Real>
bool beyond_tile(const Rectangle<Real>& r, const Vec4<Real>& light, const Cell<Real>& cell, Real margin) {
    return std::ranges::any_of(cell.planes, [&](const Vec4<Real>& plane) {
        const Vec3<Real> normal(plane);
        for (std::uint32_t i = 0; i < 4; ++i) {
            const Vec3<Real> q = r.corner(i);
            if (!(dot(normal, q) + plane.w <= -margin && dot(normal, q * light.w - Vec3<Real>(light)) <= 0)) return false;
        }
        return true;
    });
}

template <typename Real>
struct Margin {
    Real size = 0;    ///< of the numbers in a distance
    Real planes = 0;  ///< of the rectangle's own plane and the tile's
};

template <typename Real>
Margin<Real> margin_of(const Rectangle<Real>& r, const Vec4<Real>& light, const Cell<Real>& cell) {
    const Real size = length(light.w > 0 ? Vec3<Real>(light) : r.center) + cell.z_far;
    const Real bias = std::max(Real(least_surface_offset), Real(surface_offset_per_meter) * cell.z_far);
    return {.size = size, .planes = Real(classification_margin) * size + bias};
}

/// The four planes through the light and an edge.
template <typename Real>
Reach within_edges(const Rectangle<Real>& r, const Vec4<Real>& light, const Cell<Real>& cell, const Margin<Real>& margin) {
    const Real facing = dot(r.normal, Vec3<Real>(light) - r.center * light.w) < 0 ? Real(-1) : Real(1);
    bool full = true;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Vec3<Real> q = r.corner(i), edge = r.corner((i + 1) & 3) - q, to_light = Vec3<Real>(light) - q * light.w;
        const Vec3<Real> normal = facing * glm::cross(to_light, edge);  // inward
        const Real area = length(normal), lengths = length(to_light) * length(edge);
        if (!(area > Real(degenerate_sine) * lengths)) {
            full = false;
            continue;
        }
        const Real side_margin = margin.planes + Real(grazing_margin) * margin.size * (lengths / area);
        const Range<Real> inside = corner_range(cell, normal / area, q);
        if (inside.high <= -side_margin) return Reach::none;
        full = full && inside.low >= side_margin;
    }
    return full ? Reach::full : Reach::partial;
}

/// A plane through the eye, unit: its normal points into the tile.
template <typename Real>
Vec4<Real> side(const Vec3<Real>& inward) {
    return {inward / length(inward), 0};
}

}  // namespace

template <typename Real>
Cell<Real> cell_between(const TileRays<Real>& rays, Real z_near, Real z_far) {
    Cell<Real> cell;
    for (std::uint32_t i = 0; i < 8; ++i) {
        const Real z = (i & 4u) != 0 ? z_far : z_near;
        cell.corners[i] = {z * ((i & 1u) != 0 ? rays.right : rays.left), z * ((i & 2u) != 0 ? rays.bottom : rays.top), z};
    }
    cell.planes = {side<Real>({1, 0, -rays.left}),
                   side<Real>({-1, 0, rays.right}),
                   side<Real>({0, 1, -rays.bottom}),
                   side<Real>({0, -1, rays.top}),
                   {0, 0, 1, -z_near},
                   {0, 0, -1, z_far}};
    cell.z_near = z_near;
    cell.z_far = z_far;
    return cell;
}

template <typename Real>
Reach classify(const BlockerRecord& blocker, const Vec4<Real>& light, const Cell<Real>& cell) {
    const Real height = stopped_height(blocker, light);
    if (height == 0) return Reach::none;
    const Rectangle<Real> r(blocker);
    const Margin<Real> margin = margin_of(r, light, cell);
    const Range<Real> distance = corner_range(cell, (height < 0 ? Real(1) : Real(-1)) * r.normal, r.center);
    const Real behind = Real(point_behind_blocker);
    if (distance.high - behind <= -margin.planes) return Reach::none;
    const Reach edges = within_edges(r, light, cell, margin);
    if (edges == Reach::none) return Reach::none;
    if (edges == Reach::full && distance.low - behind >= margin.planes) return Reach::full;
    return beyond_tile(r, light, cell, margin.planes) ? Reach::none : Reach::partial;
}

BlockerRecord portal_rectangle(const BlockerRecord& blocker, const BlockerPortalRecord& portal) {
    const glm::vec3 v = glm::cross(blocker.normal, blocker.u);
    BlockerRecord r = blocker;
    r.center = blocker.center + blocker.u * portal.center.x + v * portal.center.y;
    r.u = blocker.u * portal.turn.x + v * portal.turn.y;
    r.half_u = portal.half_extent.x;
    r.half_v = portal.half_extent.y;
    return r;
}

template Cell<float> cell_between(const TileRays<float>&, float, float);
template Cell<double> cell_between(const TileRays<double>&, double, double);
template Reach classify(const BlockerRecord&, const Vec4<float>&, const Cell<float>&);
template Reach classify(const BlockerRecord&, const Vec4<double>&, const Cell<double>&);

}  // namespace strata::lighting
