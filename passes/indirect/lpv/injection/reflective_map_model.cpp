#include "passes/indirect/lpv/injection/reflective_map_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/indirect/lpv/injection/emission_model.h"
#include "passes/indirect/lpv/lpv.shared.h"
#include "passes/reference/lights.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/triangles.h"

namespace strata::indirect::in_double {
namespace {

// Half angles of spots end here: 85 degrees.
constexpr double widest_spot = 85 * 3.14159265358979323846 / 180;
// Meters along its axis where a map of a local light begins.
constexpr double nearest_surface = 0.05;
// Meters by which rectangles are wider than recorded, as direct light has them at least (docs/algorithms/lighting.md 2.2).
constexpr double light_slack = 1e-5;
// Meters: as much as direct light lifts places near the eye.
constexpr double lift = 0.01;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// View space, either side.
glm::dvec3 surface_normal(const Frame& frame, const Hit& hit, const Attributes& at) {
    const DrawSpace space = draw_space(frame, hit.draw);
    const glm::dvec3 vertex_normal = space.normals * at.normal;
    if (glm::dot(vertex_normal, vertex_normal) > 0) return glm::normalize(vertex_normal);
    const Corners corners = view_corners(frame, space, hit.draw, hit.triangle);
    return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

/// Where the texels of a map of parallel light lie on their plane, in cells.
struct MapLattice {
    glm::dvec2 axis{1, 0};  ///< of the first side of texels; the second is a quarter turn on
    double texel = 1;
    glm::dvec2 corner{0};      ///< of the map, along both sides
    std::uint32_t texels = 0;  ///< a side that cover all corners
};

/// Texels whose sides are (n, 1) and (-1, n) over n^2 + 1, for the largest n up to `finest` at which so many cover all corners;
/// 1, 2, 3 ... cells wide where no n does.
MapLattice map_lattice(std::span<const glm::dvec2> corners, std::uint32_t texels, double finest) {
    const auto lattice_of = [&](const glm::dvec2& side) -> std::optional<MapLattice> {
        MapLattice lattice{.axis = glm::normalize(side), .texel = glm::length(side)};
        glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
        for (const glm::dvec2& corner : corners) {
            const glm::dvec2 at(glm::dot(corner, lattice.axis), lattice.axis.x * corner.y - lattice.axis.y * corner.x);
            low = glm::min(low, at), high = glm::max(high, at);
        }
        const glm::dvec2 shift(map_shift_u, map_shift_v), wide = high - low + lattice.texel;
        if (std::max(wide.x, wide.y) > texels * lattice.texel) return std::nullopt;
        lattice.corner = (glm::floor(low / lattice.texel - shift) + shift) * lattice.texel;
        lattice.texels = std::uint32_t(std::ceil(std::max(wide.x, wide.y) / lattice.texel));
        return lattice;
    };
    for (double n = std::min(double(texels), finest); n >= 1; --n)
        if (const auto lattice = lattice_of(glm::dvec2(n, 1) / (n * n + 1))) return *lattice;
    for (double n = 1; n <= 1024; ++n)
        if (const auto lattice = lattice_of({n, 0})) return *lattice;
    return {};
}

bool is_positive(const glm::dvec3& flux) { return flux.x > 0 || flux.y > 0 || flux.z > 0; }

double spot_slope(float half_angle) { return std::tan(std::min(double(half_angle), widest_spot)); }

}  // namespace

/// A map of a local light: slopes are half its width and height at a distance of 1 along it.
struct ReflectiveMaps::MapSide {
    LightAxes axes;
    glm::dvec2 slopes{1};
    std::uint32_t texels = 0;  ///< along each
};

struct ReflectiveMaps::Surface {
    glm::dvec3 position{0}, normal{0};  ///< world; the normal on the side the ray came from
    glm::dvec3 reflectance{0};
    double distance = 0;  ///< along the ray, in lengths of its direction
};

/// The blockers of one light: as direct light asks about them, and as ways of bounced light do.
struct ReflectiveMaps::InTheWay {
    LightBlockers blockers;
    std::vector<Barrier> barriers;

    InTheWay(const Frame& frame, const Light& light) : blockers(light_blockers(frame, light)) {
        for (const LightBlocker& use : blockers.blockers) barriers.push_back(barrier(frame, use.blocker, light.portals));
    }
    /// Whether a barrier is between the light and the place that stands for a surface. The sun is 1e7 m away.
    bool part(const Light& light, const Surface& surface) const {
        const glm::dvec3 begin = way_begin(surface.position, surface.normal);
        const glm::dvec3 from =
            has_range(light.type) ? light.position : begin - 1e7 * glm::normalize(glm::dvec3(light.direction));
        return is_blocked(barriers, {from, begin}, light_slack);
    }
};

ReflectiveMaps::ReflectiveMaps(const Frame& frame, std::uint32_t most_texels, double density)
    : frame_(&frame), most_texels_(most_texels), density_(density), scene_(frame, RayMask::shadow_casters) {}

/// Calls texel(i, j) for all of a map, rows in parallel, and puts what they give in the order of the rows.
template <typename Texel>
std::vector<VirtualLight> ReflectiveMaps::map_of(std::uint32_t texels, const Texel& texel) const {
    std::vector<std::vector<VirtualLight>> rows(texels);
    tbb::parallel_for(0u, texels, [&](std::uint32_t j) {
        for (std::uint32_t i = 0; i < texels; ++i)
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

bool ReflectiveMaps::is_reached(const Light& light, const InTheWay& in_the_way, const Surface& surface) const {
    const bool is_clipped = std::ranges::any_of(
        light.clip_planes, [&](const ClipPlane& plane) { return glm::dot(plane.normal, surface.position) + plane.distance < 0; });
    if (is_clipped) return false;
    const glm::dvec3 lifted = surface.position + surface.normal * lift;
    return lets_through(in_the_way.blockers, light_point(*frame_, light), frame_->view.to_view * (lifted - frame_->view.origin));
}

std::vector<VirtualLight> ReflectiveMaps::side_of(const Light& light, const InTheWay& in_the_way, const MapSide& side) const {
    const double texel_area = 4 * side.slopes.x * side.slopes.y / (double(side.texels) * side.texels);
    return map_of(side.texels, [&](std::uint32_t i, std::uint32_t j) -> std::optional<VirtualLight> {
        const glm::dvec2 t = (glm::dvec2(i + 0.5, j + 0.5) / double(side.texels) * 2.0 - 1.0) * side.slopes;
        const glm::dvec3 direction = side.axes.along + side.axes.u * t.x + side.axes.v * t.y;
        const auto surface = met({.origin = light.position, .direction = direction, .begin = nearest_surface});
        if (!surface || !is_reached(light, in_the_way, *surface)) return std::nullopt;
        const double stretch = glm::length(direction), window = range_window(light, surface->distance * stretch);
        const double solid_angle = texel_area / (stretch * stretch * stretch);
        return VirtualLight{.position = surface->position,
                            .normal = surface->normal,
                            .flux = surface->reflectance * radiant_intensity(light, direction / stretch) * (window * solid_angle),
                            .is_behind_blocker = in_the_way.part(light, *surface)};
    });
}

/// A side of the map is 2 slope d wide at a distance d, so that d texels per cell halfway to the light's end take slope end /
/// cell times the density. Light ends at its range, or behind a grid that does not follow the eye.
std::uint32_t ReflectiveMaps::texels_of(const Light& light, std::span<const Grid> grids) const {
    if (density_ == 0) return most_texels_;
    double slope = 1;
    if (is_spot(light.type)) slope = spot_slope(light.outer_angle);
    if (facts_of(light.type).cone == LightCone::square) slope = std::max(slope, spot_slope(light.inner_angle));
    double texels = 16;
    for (const Grid& grid : grids) {
        const glm::dvec3 half = .5 * grid.cell_size * (glm::dvec3(grid.cells) + 2.0);  // a cell around it is lit, too
        const glm::dvec3 from_middle = glm::abs(light.position - (grid.origin + half - grid.cell_size));
        if (!grid.follows_eye && glm::length(glm::max(from_middle - half, 0.0)) >= double(light.range)) continue;
        const double behind = glm::length(from_middle + half), range = double(light.range);
        texels = std::max(texels, density_ * slope * (grid.follows_eye ? range : std::min(range, behind)) / grid.cell_size);
    }
    return std::uint32_t(std::min(std::ceil(texels / 8) * 8, double(most_texels_)));
}

std::vector<VirtualLight> ReflectiveMaps::of_local(const Light& light, std::span<const Grid> grids) const {
    const InTheWay in_the_way(*frame_, light);
    const std::uint32_t texels = texels_of(light, grids);
    if (is_spot(light.type)) {
        const double u = spot_slope(light.outer_angle);
        const double v = facts_of(light.type).cone == LightCone::square ? spot_slope(light.inner_angle) : u;
        return side_of(light, in_the_way, {.axes = light_axes(light), .slopes = {u, v}, .texels = texels});
    }
    std::vector<VirtualLight> all;
    for (glm::length_t face = 0; face < 6; ++face) {  // +x -x +y -y +z -z
        MapSide side{.axes = {.along = glm::dvec3(0), .u = glm::dvec3(0)}, .texels = texels};
        side.axes.along[face / 2] = face % 2 == 0 ? 1 : -1;
        side.axes.u[(face / 2 + 1) % 3] = 1;
        side.axes.v = glm::cross(side.axes.along, side.axes.u);
        const std::vector<VirtualLight> lights = side_of(light, in_the_way, side);
        all.insert(all.end(), lights.begin(), lights.end());
    }
    return all;
}

std::vector<VirtualLight> ReflectiveMaps::of_directional(const Light& light, const Grid& grid) const {
    const InTheWay in_the_way(*frame_, light);
    const glm::dvec3 along = glm::normalize(glm::dvec3(light.direction)), steepness = glm::abs(along);
    const bool is_x = steepness.x >= steepness.y && steepness.x >= steepness.z, is_y = !is_x && steepness.y >= steepness.z;
    const glm::length_t deep = is_x ? 0 : is_y ? 1 : 2;
    const glm::dvec3 way = along / along[deep];  // per meter of depth
    // The corners of the grid and a cell around it, as light brings them to the plane across the deep axis at 0, in cells.
    std::array<glm::dvec2, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 at =
            grid.origin / grid.cell_size - 1.0 + glm::dvec3(i & 1, i >> 1 & 1, i >> 2) * (glm::dvec3(grid.cells) + 2.0);
        const glm::dvec3 on_plane = at - way * at[deep];
        corners[i] = {on_plane[(deep + 1) % 3], on_plane[(deep + 2) % 3]};
    }
    const std::uint32_t most = 3 * most_texels_;
    const MapLattice lattice = map_lattice(corners, most, density_ == 0 ? most : std::ceil(3 * density_));
    const double texel = lattice.texel * grid.cell_size;
    const glm::dvec3 power = glm::max(glm::dvec3(light.intensity), 0.0) * (texel * texel * steepness[deep]);
    return map_of(density_ == 0 ? most : lattice.texels, [&](std::uint32_t i, std::uint32_t j) -> std::optional<VirtualLight> {
        const glm::dvec2 at = lattice.corner + (glm::dvec2(i, j) + 0.5) * lattice.texel;
        const glm::dvec2 flat = grid.cell_size * (at.x * lattice.axis + at.y * glm::dvec2(-lattice.axis.y, lattice.axis.x));
        glm::dvec3 origin = way * grid.origin[deep];
        origin[(deep + 1) % 3] += flat.x;
        origin[(deep + 2) % 3] += flat.y;
        const auto surface = met({.origin = origin, .direction = along, .begin = -infinity});
        if (!surface || !is_reached(light, in_the_way, *surface)) return std::nullopt;
        return VirtualLight{.position = surface->position,
                            .normal = surface->normal,
                            .flux = surface->reflectance * power,
                            .is_behind_blocker = in_the_way.part(light, *surface)};
    });
}

}  // namespace strata::indirect::in_double
