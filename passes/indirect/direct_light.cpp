// Formulas: docs/algorithms/lighting.md 0.3 and 0.4.
#include "passes/indirect/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "capture_format/light_types.h"
#include "passes/reference/directions.h"
#include "passes/reference/light_sets.h"
#include "passes/reference/lights.h"
#include "passes/reference/textures.h"

namespace strata::indirect {
namespace {

using glm::dvec2, glm::dvec3, glm::dvec4;
using std::numbers::pi;

// Meters between a ray's ends and the surfaces they belong to. Hits are exact to 1e-12 of their distance.
constexpr double ray_gap = 1e-5;
constexpr double endless = 1e9;  // meters to the sun

/// What a place of a light sends to a surface that faces it: irradiance, and where it comes from as light_point() says it.
struct Sent {
    dvec3 irradiance{0};
    dvec4 from{0};
};

dvec2 on_disc(const dvec2& place) {
    const double radius = std::sqrt(place.x), angle = 2 * pi * place.y;
    return radius * dvec2(std::cos(angle), std::sin(angle));
}

dvec3 spot_share(const PlacedLight& at, const dvec3& to_light) {
    if (glm::dot(to_light, at.direction) >= 0) return dvec3(0);
    const dvec2 place = place_in_spot(*at.light, away(at));
    const double cone = facts_of(at.light->type).cone == LightCone::round
                            ? round_spot_share(*at.light, -glm::dot(to_light, at.direction))
                            : square_spot_share(place);
    if (cone == 0 || at.light->texture == no_index) return dvec3(cone);
    if (std::abs(place.x) > 1 || std::abs(place.y) > 1) return dvec3(0);
    return cone * dvec3(bilinear(at.frame->textures[at.light->texture], 0, {0.5 * (1 + place.x), 0.5 * (1 - place.y)}));
}

Sent from_point(const PlacedLight& at, const LitSide& side) {
    const double distance = glm::length(at.offset);
    if (distance == 0) return {};
    const dvec3 to_light = at.offset / distance;
    const double near = std::max(distance, nearest_light);
    dvec3 share(std::max(0.0, glm::dot(to_light, side.normal)) / (near * near));
    if (is_spot(at.light->type) && share.x > 0) share *= spot_share(at, to_light);
    return {share, dvec4(side.position + at.offset, 1)};
}

/// A point of an emitter's surface with its outward normal, and the area that it stands for.
struct EmitterPoint {
    dvec3 to{0};  ///< from the lit point
    dvec3 normal{0};
    double area = 0;
};

Sent from_area(const EmitterPoint& point, const LitSide& side) {
    const double squared = glm::dot(point.to, point.to);
    const double cosines = std::max(0.0, glm::dot(point.to, side.normal)) * std::max(0.0, -glm::dot(point.to, point.normal));
    if (cosines <= 0) return {};
    return {dvec3(cosines / (squared * squared) * point.area), dvec4(side.position + point.to, 1)};
}

/// Uniform over the cone of directions that the sphere covers.
Sent from_sphere(const PlacedLight& at, const LitSide& side, const dvec2& place) {
    const double radius = double(at.light->source_radius), d = std::max(glm::length(at.offset), 1e-6);
    const double share = std::min(1.0, radius * radius / (d * d)), cap = share / (1 + std::sqrt(1 - share));  // 1 - cos
    const auto [u, v] = perpendiculars(at.offset / d);
    const double cosine = 1 - cap * place.x, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = 2 * pi * place.y;
    const dvec3 direction = at.offset / d * cosine + (u * std::cos(angle) + v * std::sin(angle)) * sine;
    const double near = d * cosine - std::sqrt(std::max(0.0, radius * radius - d * d * sine * sine));
    return {dvec3(2 * pi * cap * std::max(0.0, glm::dot(direction, side.normal))), dvec4(side.position + direction * near, 1)};
}

/// Uniform over the surface of the capsule: its side and its two half spheres.
EmitterPoint on_tube(const PlacedLight& at, const dvec2& place) {
    const double radius = double(at.light->source_radius), half = double(at.light->half_extent.x);
    const double along = place.x * (2 * half + 2 * radius) - half - radius, angle = 2 * pi * place.y;
    // A sphere's zones of equal height have equal areas, and those of its cylinder have the same (Archimedes).
    const double height = std::clamp(along, -half, half), lean = radius > 0 ? (along - height) / radius : 0;
    const auto [u, v] = perpendiculars(at.axis_u);
    const dvec3 around = (u * std::cos(angle) + v * std::sin(angle)) * std::sqrt(std::max(0.0, 1 - lean * lean));
    const dvec3 normal = around + at.axis_u * lean;
    return {at.offset + at.axis_u * height + normal * radius, normal, 4 * pi * radius * (half + radius)};
}

/// Of radiance or intensity 1.
Sent sent(const PlacedLight& at, const LitSide& side, const dvec2& place) {
    const Light& light = *at.light;
    switch (facts_of(light.type).shape) {
        case LightShape::parallel:
            return {dvec3(std::max(0.0, -glm::dot(at.direction, side.normal))), dvec4(-at.direction, 0)};
        case LightShape::rectangle: {
            const dvec2 half(light.half_extent), q = 2.0 * place - 1.0;
            const dvec3 to = at.offset + at.axis_u * (half.x * q.x) + at.axis_v * (half.y * q.y);
            Sent result = from_area({to, at.direction, 4 * half.x * half.y}, side);
            if (result.irradiance != dvec3(0)) result.irradiance *= emitted_color(at, q, 0);
            return result;
        }
        case LightShape::disc: {
            const double radius = double(light.source_radius);
            const dvec2 q = radius * on_disc(place);
            const auto [u, v] = perpendiculars(at.direction);
            return from_area({at.offset + u * q.x + v * q.y, at.direction, pi * radius * radius}, side);
        }
        case LightShape::sphere:
            return from_sphere(at, side, place);
        case LightShape::tube:
            return from_area(on_tube(at, place), side);
        case LightShape::point:
            break;
    }
    return from_point(at, side);
}

bool is_clipped(const Frame& frame, const Light& light, const dvec3& position) {
    if (light.clip_planes.empty()) return false;
    const dvec3 world = frame.view.origin + glm::transpose(frame.view.to_view) * position;
    return std::ranges::any_of(light.clip_planes,
                               [&](const ClipPlane& plane) { return glm::dot(plane.normal, world) + plane.distance < 0; });
}

/// A point of the source of a soft shadow: of the sun's disc, a spot's disc, or the disc as which other lights' globes are seen.
dvec4 soft_source(const Frame& frame, const PlacedLight& at, const dvec4& from, const dvec2& place) {
    const dvec2 q = on_disc(place);
    if (!has_range(at.light->type)) {
        const auto [u, v] = perpendiculars(-at.direction);
        return from + dvec4(std::tan(double(frame.sun.angular_radius)) * (u * q.x + v * q.y), 0);
    }
    const bool spot = is_spot(at.light->type);
    const double distance = glm::length(at.offset), radius = double(at.light->source_radius);
    if (distance <= radius) return from;
    const auto [u, v] = perpendiculars(spot ? at.direction : at.offset / distance);
    const double seen = spot ? radius : radius / std::sqrt(1 - radius * radius / (distance * distance));
    return from + dvec4(seen * (u * q.x + v * q.y), 0);
}

}  // namespace

DirectLight::DirectLight(const Frame& frame) : frame_(&frame), casters_(frame, RayMask::shadow_casters) {
    for (const Light& light : shining_lights(frame)) {
        Source source{light, is_area(light.type) ? all_blockers(frame, light) : light_blockers(frame, light)};
        source.light.intensity = glm::max(light.intensity, glm::vec3(0));
        if (source.light.intensity != glm::vec3(0)) sources_.push_back(std::move(source));
    }
}

bool DirectLight::is_shadowed(const Light& light, const LitSide& side, const dvec4& from) const {
    if (!light.shadow.casts) return false;
    const dvec3 origin = side.position + side.normal * ray_gap;
    const dvec3 way = from.w == 0 ? glm::normalize(dvec3(from)) * endless : dvec3(from) - origin;
    const double length = glm::length(way);
    return length > ray_gap && !casters_.clear(origin, way / length, 0, length - ray_gap);
}

dvec3 DirectLight::irradiance(std::size_t index, const LitSide& side, dvec2 place) const {
    const auto& [light, blockers] = sources_[index];
    SurfacePoint point;
    point.position = side.position;
    const PlacedLight at = placed(*frame_, point, light);
    const bool is_sun = !has_range(light.type), is_emitter = is_area(light.type);
    const double window = is_sun ? 1 : range_window(light, glm::length(at.offset));
    if (window == 0 || is_behind(at)) return dvec3(0);
    const Sent result = sent(at, side, place);
    if (result.irradiance == dvec3(0) || is_clipped(*frame_, light, side.position)) return dvec3(0);
    if (!lets_through(blockers, result.from, off_surface(side.position, side.normal))) return dvec3(0);
    const bool is_soft = !is_emitter && light.shadow.soft;
    if (is_shadowed(light, side, is_soft ? soft_source(*frame_, at, result.from, place) : result.from)) return dvec3(0);
    return result.irradiance * dvec3(light.intensity) * window;
}

}  // namespace strata::indirect
