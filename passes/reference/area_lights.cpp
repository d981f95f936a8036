// Area lights as they are done in real time, in double: outlines as lists of corners, cut at the horizon (Sutherland, Hodgman
// 1974), summed up by Lambert's formula. Linearly transformed cosines: Heitz, Dupuy, Hill, Neubelt 2016.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "capture_format/light_types.h"
#include "passes/reference/brdf.h"
#include "passes/reference/ltc_table.h"
#include "passes/reference/placed_light.h"

namespace strata {
namespace {

using glm::dvec2, glm::dvec3, glm::dmat3;
using Polygon = std::vector<dvec3>;

using std::numbers::pi;
constexpr int outline_corners = 16;  // of what is round
constexpr double widest_sine_squared = 0.9999;

// A regular polygon of these corners has the area of its circle when it is this much larger.
const double equal_area = std::sqrt(2 * pi / outline_corners / std::sin(2 * pi / outline_corners));

dvec3 perpendicular(const dvec3& a, const dvec3& b) {
    const dvec3 normal = glm::cross(a, b);
    if (glm::dot(normal, normal) > 1e-8) return glm::normalize(normal);
    return glm::normalize(glm::cross(std::abs(a.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 0, 1), a));
}

// Of something; of the point itself, the normal.
dvec3 direction_to(const dvec3& offset, const dvec3& normal) {
    return glm::length(offset) > 1e-6 ? glm::normalize(offset) : normal;
}

/// A circle of directions: center, its rim's axes.
struct Rim {
    dvec3 center, x, y;
    dvec3 at(double angle) const { return center + x * std::cos(angle) + y * std::sin(angle); }
};

// The angle under which a sphere's radius is seen.
double angle_of(double radius, double distance) {
    return std::asin(std::sqrt(std::min(std::pow(radius / std::max(distance, 1e-6), 2), widest_sine_squared)));
}

Polygon circle(const Rim& rim) {
    Polygon polygon;
    for (int i = 0; i < outline_corners; ++i) polygon.push_back(rim.at(2 * pi * i / outline_corners));
    return polygon;
}

Polygon sphere(const PlacedLight& at, const dvec3& normal) {
    const dvec3 axis = direction_to(at.offset, normal), side = perpendicular(axis, normal);
    const double size = equal_area * std::tan(angle_of(double(at.light->source_radius), glm::length(at.offset)));
    return circle({axis, size * glm::cross(side, axis), size * side});
}

Polygon disc(const PlacedLight& at, const dvec3& normal) {
    const dvec3 axis = -at.direction, side = perpendicular(axis, normal);
    const double size = equal_area * double(at.light->source_radius);
    return circle({at.offset, size * glm::cross(side, axis), size * side});
}

Polygon rectangle(const PlacedLight& at) {
    const dvec3 u = at.axis_u * double(at.light->half_extent.x), v = at.axis_v * double(at.light->half_extent.y);
    return {at.offset + u - v, at.offset - u - v, at.offset - u + v, at.offset + u + v};
}

// Angle, from the direction to the other end, at which the plane that touches both end spheres touches this one; a, b their seen
// radii, apart the angle between them. Less than 0 or more than pi: one is hidden behind the other.
double touching_cosine(double a, double b, double apart) {
    return (std::sin(a) * std::cos(apart) - std::sin(b)) / std::max(std::cos(a) * std::sin(apart), 1e-7);
}

// The convex hull of the circles under which the spheres at both ends are seen.
Polygon tube(const PlacedLight& at, const dvec3& normal) {
    const dvec3 half = at.axis_u * double(at.light->half_extent.x);
    const dvec3 ends[2] = {at.offset - half, at.offset + half};
    const dvec3 axes[2] = {direction_to(ends[0], normal), direction_to(ends[1], normal)};
    const dvec3 crossed = glm::cross(axes[0], axes[1]);
    const dvec3 side = glm::length(crossed) > 1e-5 ? glm::normalize(crossed) : perpendicular(axes[0], normal);
    const double apart = std::atan2(glm::length(crossed), glm::dot(axes[0], axes[1]));
    double seen[2], touch[2];
    Rim rims[2];
    for (int i : {0, 1}) {
        seen[i] = angle_of(double(at.light->source_radius), glm::length(ends[i]));
        rims[i] = {axes[i], glm::cross(side, axes[i]) * std::tan(seen[i]), side * std::tan(seen[i])};
    }
    touch[0] = touching_cosine(seen[0], seen[1], apart);
    touch[1] = -touching_cosine(seen[1], seen[0], apart);
    const double split = 0.5 * (std::clamp(touch[0], -2.0, 2.0) + std::clamp(touch[1], -2.0, 2.0));
    const auto touched = [&](int rim, double sign) { return rims[rim].at(sign * std::acos(std::clamp(touch[rim], -1.0, 1.0))); };
    Polygon polygon;
    for (int i = 0; i < outline_corners; ++i) {
        const double angle = 2 * pi * i / outline_corners, next = 2 * pi * (i + 1) / outline_corners;
        const int from = std::cos(angle) > split ? 1 : 0, to = std::cos(next) > split ? 1 : 0;
        polygon.push_back(rims[from].center + equal_area * (rims[from].at(angle) - rims[from].center));
        if (from == to) continue;
        const double sign = angle < pi ? 1 : -1;
        polygon.push_back(touched(from, sign));
        polygon.push_back(touched(to, sign));
    }
    return polygon;
}

// Around the surface at the origin, counter-clockwise seen from there.
Polygon outline(const PlacedLight& at, const dvec3& normal) {
    switch (facts_of(at.light->type).shape) {
        case LightShape::sphere:
            return sphere(at, normal);
        case LightShape::disc:
            return disc(at, normal);
        case LightShape::tube:
            return tube(at, normal);
        default:
            return rectangle(at);
    }
}

Polygon above_horizon(const Polygon& polygon) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (a.z > 0) kept.push_back(a);
        if ((a.z > 0) != (b.z > 0)) kept.push_back(a + (b - a) * (a.z / (a.z - b.z)));
    }
    return kept;
}

// The integral of the direction over the polygon's part above z = 0.
dvec3 flux(const Polygon& polygon, const dmat3& to) {
    Polygon moved;
    for (const dvec3& corner : polygon) moved.push_back(to * corner);
    moved = above_horizon(moved);
    dvec3 sum(0);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const dvec3 a = glm::normalize(moved[i]), b = glm::normalize(moved[(i + 1) % moved.size()]), normal = glm::cross(a, b);
        const double sine = glm::length(normal);
        if (sine > 0) sum += normal * (std::atan2(sine, glm::dot(a, b)) / sine);
    }
    return 0.5 * sum;
}

// Rotates `up` to +z and `towards` into the half plane of +x.
dmat3 frame_of(const dvec3& up, const dvec3& towards) {
    const dvec3 side = perpendicular(up, towards);
    return glm::transpose(dmat3(glm::cross(side, up), side, up));
}

/// A lobe of directions: its axis in view space, the tangent of its half width.
struct Lobe {
    dvec3 axis;
    double half_width;
};

dvec3 radiance(const PlacedLight& at, const Lobe& lobe) {
    const dvec3 intensity = at.light->intensity;
    if (facts_of(at.light->type).shape != LightShape::rectangle || at.light->texture == no_index) return intensity;
    const Texture& texture = at.frame->textures[at.light->texture];
    const double along = glm::dot(at.offset, at.direction) / std::min(glm::dot(lobe.axis, at.direction), -1e-4);
    const dvec3 hit = along * lobe.axis - at.offset;
    const dvec2 half = glm::max(dvec2(at.light->half_extent), dvec2(1e-6));
    const dvec2 place = glm::clamp(dvec2(glm::dot(hit, at.axis_u), glm::dot(hit, at.axis_v)) / half, -1.0, 1.0);
    const dvec2 covered = dvec2(texture.width, texture.height) * (along * lobe.half_width) / (2.0 * half);
    return intensity * emitted_color(at, place, std::log2(std::max({1.0, covered.x, covered.y})));
}

// Towards the nearest point of the emitter, or against the direction of a flat one: all of it lies on that side.
dvec3 facing(const PlacedLight& at, const dvec3& normal) {
    const LightShape shape = facts_of(at.light->type).shape;
    if (shape == LightShape::sphere) return direction_to(at.offset, normal);
    if (shape != LightShape::tube) return -at.direction;
    const double half = double(at.light->half_extent.x);
    return direction_to(at.offset + at.axis_u * std::clamp(-glm::dot(at.offset, at.axis_u), -half, half), normal);
}

// Everything arrives from the mean direction; the lobe is wider by a third of the emitter's seen radius (after Karis 2013).
dvec3 as_one_direction(const SurfacePoint& surface, const PlacedLight& at, const Polygon& polygon) {
    const dmat3 to_facing = frame_of(facing(at, surface.normal), surface.normal);
    const dvec3 sum = glm::transpose(to_facing) * flux(polygon, to_facing);
    const double irradiance = glm::length(sum);
    if (irradiance < 1e-20) return dvec3(0);
    const dvec3 l = sum / irradiance;
    SurfacePoint widened = surface;
    const double sine = std::sqrt(std::min(irradiance / pi, 1.0));
    widened.roughness = std::sqrt(std::clamp(surface.roughness * surface.roughness + sine / 3, 0.0, 1.0));
    const double cosine = brdf_cosine(widened, l);
    return brdf(widened, l, glm::normalize(-surface.position)) * (cosine * irradiance) * radiance(at, {l, 1});
}

// What Burley's diffuse is of Lambert's, for a light in one direction.
double diffuse_shape(const SurfacePoint& surface, const dvec3& l) {
    const auto shape = surface.model == LightingModel::burley         ? renormalized_burley
                       : surface.model == LightingModel::plain_burley ? burley
                                                                      : nullptr;
    if (!shape) return 1;
    const dvec3 v = glm::normalize(-surface.position);
    const auto cosine = [](const dvec3& a, const dvec3& b, double least) { return std::clamp(glm::dot(a, b), least, 1.0); };
    return shape(surface.roughness, cosine(surface.normal, l, 0), cosine(surface.normal, v, smallest_cosine),
                 cosine(l, glm::normalize(l + v), 0));
}

// The highlight over a diffuse layer.
dvec3 with_highlight(const SurfacePoint& surface, const PlacedLight& at, const Polygon& polygon, const dvec3& diffuse) {
    const dvec3 v = glm::normalize(-surface.position);
    const dmat3 to_normal = frame_of(surface.normal, v);
    const Ltc lobe = ltc_at(surface.roughness, std::max(glm::dot(surface.normal, v), smallest_cosine));
    const dmat3 matrix(dvec3(lobe.m11, 0, lobe.m31), dvec3(0, lobe.m22, 0), dvec3(lobe.m13, 0, lobe.m33));
    const double share = std::max(flux(polygon, glm::inverse(matrix) * to_normal).z / pi, 0.0);
    const dvec3 f0 = glm::mix(dvec3(0.04), surface.base_color, surface.metallic);
    const Lobe from{glm::transpose(to_normal) * glm::normalize(matrix[2]), std::sqrt(std::abs(glm::determinant(matrix)))};
    const dvec3 mirrored = reflectance(lobe, surface.model, f0);
    const dvec3 left = surface.model == LightingModel::multiscatter_ggx ? 1.0 - mirrored : dvec3(1);
    return diffuse * left + mirrored * share * radiance(at, from);
}

// A bent lobe may reach below the horizon: nothing arrives from an emitter that is all there.
dvec3 by_outline(const SurfacePoint& surface, const PlacedLight& at, const Polygon& polygon) {
    const dmat3 to_normal = frame_of(surface.normal, -surface.position);
    const dvec3 sum = flux(polygon, to_normal);
    if (sum.z <= 0) return dvec3(0);
    const Lobe from{glm::transpose(to_normal) * glm::normalize(sum), 1};
    const dvec3 lambert = surface.base_color * (sum.z / pi) * radiance(at, from);
    if (surface.model == LightingModel::lambert) return lambert;
    return with_highlight(surface, at, polygon, lambert * ((1 - surface.metallic) * diffuse_shape(surface, from.axis)));
}

bool has_outline(LightingModel model) {
    return model != LightingModel::cloth && model != LightingModel::skin && model != LightingModel::hair;
}

}  // namespace

glm::dvec3 reflected_area(const SurfacePoint& surface, const PlacedLight& at) {
    const Polygon polygon = outline(at, surface.normal);
    return has_outline(surface.model) ? by_outline(surface, at, polygon) : as_one_direction(surface, at, polygon);
}

}  // namespace strata
