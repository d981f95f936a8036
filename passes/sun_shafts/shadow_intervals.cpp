// Shadow intervals of rays by swept triangles.
#include "passes/sun_shafts/shadow_intervals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "passes/reference/directions.h"
#include "passes/reference/fragments.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/triangles.h"

namespace strata::sun_shafts {
namespace {

// Looks at a masked caster's alpha along one shadowed part of a ray, and halvings of each change.
constexpr int looks = 64, halvings = 40;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Keeps the part of an interval where offset + slope * t >= 0; false where nothing is left.
bool keep_positive(double offset, double slope, Interval& part) {
    if (slope == 0) return offset >= 0;
    const double root = -offset / slope;
    if (slope > 0) part.begin = std::max(part.begin, root);
    else part.end = std::min(part.end, root);
    return part.begin < part.end;
}

/// Twice the areas that a place spans with each side, over the triangle's: barycentric coordinates.
glm::dvec3 barycentric(const std::array<glm::dvec3, 3>& c, const glm::dvec2& p) {
    const glm::dvec2 a(c[0]), b(c[1]), d(c[2]);
    const double area = cross(b - a, d - a);
    const double u = cross(p - a, d - a) / area, v = cross(b - a, p - a) / area;
    return {1 - u - v, u, v};
}

std::vector<Interval> merged(std::vector<Interval> parts) {
    std::ranges::sort(parts, {}, &Interval::begin);
    std::vector<Interval> whole;
    for (const Interval& part : parts) {
        if (whole.empty() || part.begin > whole.back().end) whole.push_back(part);
        else whole.back().end = std::max(whole.back().end, part.end);
    }
    return whole;
}

}  // namespace

ShadowVolumes::ShadowVolumes(const Frame& frame) : frame_(&frame) {
    const glm::dvec3 to_sun = -(frame.view.to_view * glm::normalize(glm::dvec3(frame.sun.direction)));
    const auto [x, y] = perpendiculars(to_sun);
    to_sun_space_ = glm::transpose(glm::dmat3(x, y, to_sun));
    for (const std::uint32_t draw : opaque_draws(frame)) {
        if (!frame.draws[draw].casts_shadow) continue;
        const DrawSpace space = draw_space(frame, draw);
        const bool masked = material_of(frame, draw)->alpha_mode == AlphaMode::mask;
        for (std::uint32_t i = 0; i < triangle_count(frame, draw); ++i) {
            Caster caster{.corners = view_corners(frame, space, draw, i), .draw = draw, .triangle = i, .masked = masked};
            for (glm::dvec3& corner : caster.corners) corner = to_sun_space_ * corner;
            const auto& c = caster.corners;
            if (cross(glm::dvec2(c[1] - c[0]), glm::dvec2(c[2] - c[0])) == 0) continue;  // edge on: no shadow
            caster.low = glm::min(glm::dvec2(c[0]), glm::min(glm::dvec2(c[1]), glm::dvec2(c[2])));
            caster.high = glm::max(glm::dvec2(c[0]), glm::max(glm::dvec2(c[1]), glm::dvec2(c[2])));
            casters_.push_back(caster);
        }
    }
}

bool ShadowVolumes::shadowed(const Caster& caster, const Ray& ray, Interval& part) {
    const auto& c = caster.corners;
    const glm::dvec2 way(ray.per_meter), a(c[0]), b(c[1]), d(c[2]);
    const double area = cross(b - a, d - a), side = area > 0 ? 1 : -1;
    part = {0, ray.length};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 from(c[i]), along = glm::dvec2(c[(i + 1) % 3]) - from;
        if (!keep_positive(-side * cross(along, from), side * cross(along, way), part)) return false;
    }
    // The height of the plane over the ray's place less that of the ray: above 0 the plane is nearer to the sun.
    const glm::dvec2 e(c[1] - c[0]), f(c[2] - c[0]);
    const double e_height = c[1].z - c[0].z, f_height = c[2].z - c[0].z;
    const glm::dvec2 gradient = glm::dvec2(e_height * f.y - f_height * e.y, f_height * e.x - e_height * f.x) / area;
    return keep_positive(c[0].z - glm::dot(gradient, a), glm::dot(gradient, way) - ray.per_meter.z, part);
}

void ShadowVolumes::add_masked(const Caster& caster, const Ray& ray, const Interval& part, std::vector<Interval>& parts) const {
    const double cutoff = double(material_of(*frame_, caster.draw)->mask_cutoff);
    const auto solid = [&](double t) {
        const glm::dvec3 where = barycentric(caster.corners, glm::dvec2(ray.per_meter) * t);
        return alpha_at(*frame_, caster.draw, caster.triangle, where) >= cutoff;
    };
    double before = part.begin, begin = part.begin;
    bool was_solid = solid(before);
    for (int i = 1; i <= looks; ++i) {
        const double t = glm::mix(part.begin, part.end, double(i) / looks);
        const bool is_solid = solid(t);
        if (is_solid != was_solid) {
            double low = before, high = t;
            for (int k = 0; k < halvings; ++k) (solid(0.5 * (low + high)) == was_solid ? low : high) = 0.5 * (low + high);
            if (was_solid) parts.push_back({begin, high});
            begin = high;
        }
        was_solid = is_solid;
        before = t;
    }
    if (was_solid) parts.push_back({begin, part.end});
}

std::vector<Interval> ShadowVolumes::shadows(const glm::dvec3& direction, double length) const {
    const glm::dvec3 per_meter = to_sun_space_ * direction;
    const glm::dvec2 end = glm::dvec2(per_meter) * length;
    const Ray ray{per_meter, glm::min(end, glm::dvec2(0)), glm::max(end, glm::dvec2(0)), length};
    std::vector<Interval> parts;
    for (const Caster& caster : casters_) {
        const bool is_apart =
            caster.low.x > ray.high.x || caster.high.x < ray.low.x || caster.low.y > ray.high.y || caster.high.y < ray.low.y;
        Interval part;
        if (is_apart || !shadowed(caster, ray, part)) continue;
        if (caster.masked) add_masked(caster, ray, part, parts);
        else parts.push_back(part);
    }
    return merged(std::move(parts));
}

double scattered_share(std::span<const Interval> shadows, double length, double density) {
    double sum = -std::expm1(-density * length);
    for (const Interval& shadow : shadows)  // exp(-a) - exp(-b)
        sum += std::exp(-density * shadow.begin) * std::expm1(-density * (shadow.end - shadow.begin));
    return std::max(sum, 0.0);
}

}  // namespace strata::sun_shafts
