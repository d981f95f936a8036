#include "passes/indirect/lpv/injection/reflective_map_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/indirect/lpv/injection/emission_model.h"
#include "passes/reference/lights.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/triangles.h"

namespace strata::indirect::in_double {
namespace {

// Half angles of spots end here: 85 degrees.
constexpr double widest_spot = 85 * 3.14159265358979323846 / 180;
// Meters along its axis where a map of a local light begins.
constexpr double nearest_surface = 0.05;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// View space, either side.
glm::dvec3 surface_normal(const Frame& frame, const Hit& hit, const Attributes& at) {
    const DrawSpace space = draw_space(frame, hit.draw);
    const glm::dvec3 vertex_normal = space.normals * at.normal;
    if (glm::dot(vertex_normal, vertex_normal) > 0) return glm::normalize(vertex_normal);
    const Corners corners = view_corners(frame, space, hit.draw, hit.triangle);
    return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

bool is_positive(const glm::dvec3& flux) { return flux.x > 0 || flux.y > 0 || flux.z > 0; }

double spot_slope(float half_angle) { return std::tan(std::min(double(half_angle), widest_spot)); }

}  // namespace

/// A map of a local light: slopes are half its width and height at a distance of 1 along it.
struct ReflectiveMaps::MapSide {
    LightAxes axes;
    glm::dvec2 slopes{1};
};

struct ReflectiveMaps::Surface {
    glm::dvec3 position{0}, normal{0};  ///< world; the normal on the side the ray came from
    glm::dvec3 reflectance{0};
    double distance = 0;  ///< along the ray, in lengths of its direction
};

ReflectiveMaps::ReflectiveMaps(const Frame& frame, std::uint32_t texels_a_side)
    : frame_(&frame), texels_(texels_a_side), scene_(frame, RayMask::shadow_casters) {}

/// Calls texel(i, j) for all of a map, rows in parallel, and puts what they give in the order of the rows.
template <typename Texel>
std::vector<VirtualLight> ReflectiveMaps::map_of(const Texel& texel) const {
    std::vector<std::vector<VirtualLight>> rows(texels_);
    tbb::parallel_for(0u, texels_, [&](std::uint32_t j) {
        for (std::uint32_t i = 0; i < texels_; ++i)
            if (const std::optional<VirtualLight> light = texel(i, j); light && is_positive(light->flux))
                rows[j].push_back(*light);
    });
    std::vector<VirtualLight> all;
    for (const std::vector<VirtualLight>& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

std::optional<ReflectiveMaps::Surface> ReflectiveMaps::met(const LightRay& ray) const {
    const glm::dvec3 direction = frame_->view.to_view * ray.direction;
    const std::optional<Hit> hit =
        scene_.closest(frame_->view.to_view * (ray.origin - frame_->view.origin), direction, ray.begin, infinity);
    if (!hit) return std::nullopt;
    const Attributes at = attributes_at(*frame_, hit->draw, hit->triangle, hit->barycentric);
    const glm::dvec3 normal = surface_normal(*frame_, *hit, at);
    Surface surface;
    surface.position = ray.origin + ray.direction * hit->distance;
    surface.normal = glm::transpose(frame_->view.to_view) * (glm::dot(normal, direction) > 0 ? -normal : normal);
    surface.reflectance = glm::min(diffuse_albedo(*frame_, hit->draw, at), 1.0);  // no more than arrives
    surface.distance = hit->distance;
    return surface;
}

bool ReflectiveMaps::is_reached(const Light& light, const LightBlockers& blockers, const Surface& surface) const {
    const bool is_clipped = std::ranges::any_of(
        light.clip_planes, [&](const ClipPlane& plane) { return glm::dot(plane.normal, surface.position) + plane.distance < 0; });
    if (is_clipped) return false;
    const glm::dvec3 position = frame_->view.to_view * (surface.position - frame_->view.origin);
    return lets_through(blockers, light_point(*frame_, light), off_surface(position, frame_->view.to_view * surface.normal));
}

std::vector<VirtualLight> ReflectiveMaps::side_of(const Light& light, const LightBlockers& blockers, const MapSide& side) const {
    const double texel_area = 4 * side.slopes.x * side.slopes.y / (double(texels_) * texels_);
    return map_of([&](std::uint32_t i, std::uint32_t j) -> std::optional<VirtualLight> {
        const glm::dvec2 t = (glm::dvec2(i + 0.5, j + 0.5) / double(texels_) * 2.0 - 1.0) * side.slopes;
        const glm::dvec3 direction = side.axes.along + side.axes.u * t.x + side.axes.v * t.y;
        const auto surface = met({.origin = light.position, .direction = direction, .begin = nearest_surface});
        if (!surface || !is_reached(light, blockers, *surface)) return std::nullopt;
        const double stretch = glm::length(direction), window = range_window(light, surface->distance * stretch);
        const double solid_angle = texel_area / (stretch * stretch * stretch);
        return VirtualLight{
            .position = surface->position,
            .normal = surface->normal,
            .flux = surface->reflectance * radiant_intensity(light, direction / stretch) * (window * solid_angle)};
    });
}

std::vector<VirtualLight> ReflectiveMaps::of_local(const Light& light) const {
    const LightBlockers blockers = light_blockers(*frame_, light);
    if (is_spot(light.type)) {
        const double u = spot_slope(light.outer_angle);
        const double v = facts_of(light.type).cone == LightCone::square ? spot_slope(light.inner_angle) : u;
        return side_of(light, blockers, {.axes = light_axes(light), .slopes = {u, v}});
    }
    std::vector<VirtualLight> all;
    for (glm::length_t face = 0; face < 6; ++face) {  // +x -x +y -y +z -z
        MapSide side{.axes = {.along = glm::dvec3(0), .u = glm::dvec3(0)}};
        side.axes.along[face / 2] = face % 2 == 0 ? 1 : -1;
        side.axes.u[(face / 2 + 1) % 3] = 1;
        side.axes.v = glm::cross(side.axes.along, side.axes.u);
        const std::vector<VirtualLight> lights = side_of(light, blockers, side);
        all.insert(all.end(), lights.begin(), lights.end());
    }
    return all;
}

std::vector<VirtualLight> ReflectiveMaps::of_directional(const Light& light, const Grid& grid) const {
    const LightBlockers blockers = light_blockers(*frame_, light);
    const LightAxes axes = axes_around(light.direction);
    const glm::dvec3 &along = axes.along, &u = axes.u, &v = axes.v;
    const glm::dvec3 half = grid.cell_size * glm::dvec3(grid.cells) / 2.0, middle = grid.origin + half;
    const double radius = glm::length(half), texel = 2 * radius / texels_;
    const glm::dvec2 corner = glm::floor((glm::dvec2(glm::dot(middle, u), glm::dot(middle, v)) - radius) / texel) * texel;
    const glm::dvec3 power = glm::max(glm::dvec3(light.intensity), 0.0) * (texel * texel);
    return map_of([&](std::uint32_t i, std::uint32_t j) -> std::optional<VirtualLight> {
        const glm::dvec2 at = corner + glm::dvec2(i + 0.5, j + 0.5) * texel;
        const glm::dvec3 origin = u * at.x + v * at.y + along * glm::dot(along, middle);
        const auto surface = met({.origin = origin, .direction = along, .begin = -infinity});
        if (!surface || !is_reached(light, blockers, *surface)) return std::nullopt;
        return VirtualLight{.position = surface->position, .normal = surface->normal, .flux = surface->reflectance * power};
    });
}

}  // namespace strata::indirect::in_double
