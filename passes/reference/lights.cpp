// Points, spots and the sun; where areas come in.
#include "passes/reference/lights.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "capture_format/light_types.h"
#include "passes/reference/placed_light.h"
#include "passes/reference/textures.h"

namespace strata {
namespace {

// Share of a square spot's half width over which it fades (docs/algorithms/lighting.md 0.4, f).
constexpr double square_feather = 0.1;
// Least difference of the cosines of a round spot's angles.
constexpr double least_cone = 1e-4;

// Tangents of the half angles of what a spot throws: a square one has its own for u and v.
glm::dvec2 spread(const Light& light) {
    const double u = std::tan(double(light.outer_angle));
    return {u, facts_of(light.type).cone == LightCone::square ? std::tan(double(light.inner_angle)) : u};
}

double spot_share(const PlacedLight& at, const glm::dvec3& to_light) {
    if (facts_of(at.light->type).cone == LightCone::round) return round_spot_share(*at.light, glm::dot(-to_light, at.direction));
    if (glm::dot(-to_light, at.direction) <= 0) return 0;
    return square_spot_share(place_in_spot(*at.light, away(at)));
}

// Bilinear in one mip with black around: taps outside count nothing.
glm::dvec3 bordered(const Texture& texture, std::uint32_t mip, const glm::dvec2& uv) {
    const glm::dvec2 size(std::max(1u, texture.width >> mip), std::max(1u, texture.height >> mip));
    const glm::dvec2 at = uv * size - 0.5;
    const glm::dvec2 low = glm::floor(at);
    glm::dvec3 sum(0);
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 tap = low + glm::dvec2(i % 2, i / 2);
        if (tap.x < 0 || tap.y < 0 || tap.x >= size.x || tap.y >= size.y) continue;
        const double weight = (1 - std::abs(at.x - tap.x)) * (1 - std::abs(at.y - tap.y));
        sum += weight * glm::dvec3(texel(texture, mip, static_cast<std::uint32_t>(tap.x), static_cast<std::uint32_t>(tap.y)));
    }
    return sum;
}

glm::dvec3 thrown_color(const PlacedLight& at, const SurfacePoint& surface) {
    const View& view = at.frame->view;
    const Texture& texture = at.frame->textures[at.light->texture];
    const double facing = std::max(glm::dot(surface.normal, glm::normalize(-surface.position)), 0.1);
    const double pixel = 2 * surface.position.z / (view.height * std::abs(double(view.projection[1][1])) * facing);
    const glm::dvec2 width = 2 * glm::dot(-at.offset, at.direction) * spread(*at.light);
    const glm::dvec2 covered = glm::dvec2(texture.width, texture.height) * pixel / width;
    const double lod = std::clamp(std::log2(std::max(covered.x, covered.y)), 0.0, double(texture.mips - 1));
    const glm::dvec2 place = place_in_spot(*at.light, away(at)), uv(0.5 * (1 + place.x), 0.5 * (1 - place.y));
    const auto mip = static_cast<std::uint32_t>(lod);
    const glm::dvec3 fine = bordered(texture, mip, uv);
    return lod == mip ? fine : glm::mix(fine, bordered(texture, mip + 1, uv), lod - mip);
}

struct Incident {
    glm::dvec3 to_light{0};
    glm::dvec3 irradiance{0};  ///< on a plane facing the light
};

Incident incident(const PlacedLight& at, const SurfacePoint& surface) {
    const glm::dvec3 intensity = at.light->intensity;
    if (!has_range(at.light->type)) return {-at.direction, intensity};
    const double distance = glm::length(at.offset);
    if (distance == 0) return {};
    const glm::dvec3 to_light = at.offset / distance;
    const double squared = std::max(distance * distance, nearest_light * nearest_light);
    glm::dvec3 share(range_window(*at.light, distance) / squared);
    if (is_spot(at.light->type)) {
        share *= spot_share(at, to_light);
        if (share != glm::dvec3(0) && at.light->texture != no_index) share *= thrown_color(at, surface);
    }
    return {to_light, intensity * share};
}

bool clipped(const Frame& frame, const SurfacePoint& surface, const Light& light) {
    const glm::dvec3 world = frame.view.origin + glm::transpose(frame.view.to_view) * surface.position;
    return std::ranges::any_of(light.clip_planes,
                               [&](const ClipPlane& plane) { return glm::dot(plane.normal, world) + plane.distance < 0; });
}

glm::dvec3 reflected_punctual(const SurfacePoint& surface, const PlacedLight& at) {
    const Incident arriving = incident(at, surface);
    if (arriving.irradiance == glm::dvec3(0)) return glm::dvec3(0);
    const double cosine = brdf_cosine(surface, arriving.to_light);
    if (cosine <= 0) return glm::dvec3(0);
    return brdf(surface, arriving.to_light, glm::normalize(-surface.position)) * arriving.irradiance * cosine;
}

// What either form of an area light is multiplied with: 0 where there is nothing to reflect.
double area_window(const SurfacePoint& surface, const PlacedLight& at) {
    if (surface.model == LightingModel::unlit || is_behind(at)) return 0;
    return range_window(*at.light, glm::length(at.offset));
}

}  // namespace

double range_window(const Light& light, double distance) {
    if (distance >= double(light.range)) return 0;
    const double rest = 1 - std::pow(distance / double(light.range), 4);
    return light.window == RangeWindow::quartic ? rest : rest * rest;
}

double square_edge(double s, double feather) {
    if (feather <= 0) return s <= 1 ? 1 : 0;
    const double t = std::clamp((s - (1 - feather)) / feather, 0.0, 1.0);
    return 1 - t * t * (3 - 2 * t);
}

glm::dvec2 place_in_spot(const Light& light, const glm::dvec3& away) { return glm::dvec2(away) / (away.z * spread(light)); }

double square_spot_share(const glm::dvec2& place) {
    return square_edge(std::abs(place.x), square_feather) * square_edge(std::abs(place.y), square_feather);
}

double round_spot_share(const Light& light, double cosine) {
    const double outer = std::cos(double(light.outer_angle)), inner = std::cos(double(light.inner_angle));
    const double t = std::clamp((cosine - outer) / std::max(inner - outer, least_cone), 0.0, 1.0);
    return t * t;
}

PlacedLight placed(const Frame& frame, const SurfacePoint& surface, const Light& light) {
    const glm::dvec3 direction = frame.view.to_view * glm::dvec3(light.direction);
    const glm::dvec3 axis_u = frame.view.to_view * glm::dvec3(light.axis_u);
    return {&frame, &light, to_view(frame, light.position) - surface.position, direction, axis_u, glm::cross(direction, axis_u)};
}

glm::dvec3 away(const PlacedLight& at) {
    return {-glm::dot(at.offset, at.axis_u), -glm::dot(at.offset, at.axis_v), -glm::dot(at.offset, at.direction)};
}

bool is_behind(const PlacedLight& at) { return is_flat(at.light->type) && glm::dot(-at.offset, at.direction) <= 0; }

glm::dvec3 emitted_color(const PlacedLight& at, const glm::dvec2& place, double lod) {
    if (facts_of(at.light->type).shape != LightShape::rectangle || at.light->texture == no_index) return glm::dvec3(1);
    Texture const& texture = at.frame->textures[at.light->texture];
    // Within half a texel of the border there is no other side to repeat.
    const auto inside = [&](const glm::dvec2& uv, std::uint32_t mip) {
        const glm::dvec2 half = 0.5 / glm::dvec2(std::max(1u, texture.width >> mip), std::max(1u, texture.height >> mip));
        return glm::dvec3(bilinear(texture, mip, glm::clamp(uv, half, 1.0 - half)));
    };
    const glm::dvec2 uv(0.5 * (1 + place.x), 0.5 * (1 - place.y));
    const double level = std::clamp(lod, 0.0, double(texture.mips - 1));
    const auto mip = static_cast<std::uint32_t>(level);
    return level == mip ? inside(uv, mip) : glm::mix(inside(uv, mip), inside(uv, mip + 1), level - mip);
}

glm::dvec3 reflected(const Frame& frame, const SurfacePoint& surface, const Light& light) {
    const PlacedLight at = placed(frame, surface, light);
    if (clipped(frame, surface, light)) return glm::dvec3(0);
    if (!is_area(light.type)) return reflected_punctual(surface, at);
    const double window = area_window(surface, at);
    return window > 0 ? window * reflected_area(surface, at) : glm::dvec3(0);
}

glm::dvec3 exact_reflected(const Frame& frame, const SurfacePoint& surface, const Light& light, const ExactOptions& options) {
    const PlacedLight at = placed(frame, surface, light);
    if (clipped(frame, surface, light)) return glm::dvec3(0);
    if (is_area(light.type)) {
        const double window = area_window(surface, at);
        return window > 0 ? window * exact_reflected_area(surface, at, options) : glm::dvec3(0);
    }
    const glm::dvec3 radiance = reflected_punctual(surface, at);
    if (!options.visible || radiance == glm::dvec3(0)) return radiance;
    const bool directional = !has_range(light.type);
    return radiance * options.visible(directional ? glm::dvec4(-at.direction, 0) : glm::dvec4(surface.position + at.offset, 1));
}

}  // namespace strata
