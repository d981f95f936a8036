#include "passes/indirect/lpv/injection/maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/frustum.h"
#include "passes/scene/light_pyramids.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"
#include "passes/scene/view_space.h"

namespace strata::indirect {
namespace {

/// A matrix from its rows, each (x, y, z, 1) dotted.
MapPush rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& depth, const glm::dvec4& w) {
    return {glm::mat4(glm::transpose(glm::dmat4(x, y, depth, w)))};
}

/// The sphere around a grid.
double radius(const LightGrid& grid) { return .5 * grid.cell * glm::length(glm::dvec3(grid.cells)); }

double strongest(const Light& light) { return std::max({0.f, light.intensity.x, light.intensity.y, light.intensity.z}); }

/// W/sr where the light is brightest, for an intensity of 1.
double widest_side(const Light& light) {
    const double r = light.source_radius, disc = std::numbers::pi * r * r;
    switch (facts_of(light.type).shape) {
        case LightShape::sphere:
        case LightShape::disc:
            return disc;
        case LightShape::rectangle:
            return 4. * double(light.half_extent.x) * double(light.half_extent.y);
        case LightShape::tube:
            return 4. * r * double(light.half_extent.x) + disc;
        default:
            return 1;
    }
}

/// Steradians that a light shines into; square meters of parallel light over the grid.
double extent(const Light& light, const LightGrid& grid) {
    // Surfaces that light cells at the border may lie a cell outside of the grid.
    if (!has_range(light.type)) return std::pow(2 * (radius(grid) + 2 * grid.cell), 2);
    const double round = facts_of(light.type).cone == LightCone::round ? 1 - std::cos(double(light.outer_angle)) : 2;
    return 2 * std::numbers::pi * round;
}

/// The box of a grid and a cell around it: surfaces beside a cell light it.
struct MappedBox {
    glm::dvec3 low, high;
    double cell;

    explicit MappedBox(const LightGrid& grid)
        : low(grid.origin - grid.cell), high(grid.origin + grid.cell * (glm::dvec3(grid.cells) + 1.)), cell(grid.cell) {}
};

/// A place in view space as a map of the light at `from` sees it.
glm::dvec3 seen_along(const LightPyramid& pyramid, const glm::dvec3& from, const glm::dvec3& place) {
    const glm::dvec3 offset = place - from;
    return {glm::dot(offset, pyramid.u), glm::dot(offset, pyramid.v()), glm::dot(offset, pyramid.along)};
}

constexpr double near = .05;  // meters; depth is reversed and infinite, so that it costs nothing to be near

/// The part of a map in which boxes lie, x and y from -1 to 1.
class SeenPart {
public:
    /// Corners as the map sees them, in the order of corners_of(): those of an edge differ in one bit.
    void add(const std::array<glm::dvec3, 8>& corners, const glm::dvec2& slopes) {
        for (unsigned i = 0; i < 8; ++i)
            for (unsigned bit = 1; bit < 8; bit <<= 1)
                if ((i & bit) == 0) add_edge(corners[i], corners[i | bit], slopes);
    }
    bool is_empty() const { return glm::any(glm::greaterThan(low_, high_)); }
    /// A texel more on each side, as devices round edges.
    MapPart texels(std::uint32_t size) const {
        const auto texel = [&](double at) { return std::clamp((at + 1) / 2, 0., 1.) * size; };
        const auto begin = [&](double at) { return std::uint32_t(std::max(std::floor(texel(at)) - 1, 0.)); };
        const auto end = [&](double at) { return std::uint32_t(std::min(std::ceil(texel(at)) + 1, double(size))); };
        return {.columns = {begin(low_.x), end(high_.x) - begin(low_.x)}, .rows = {begin(low_.y), end(high_.y) - begin(low_.y)}};
    }

private:
    /// Adds the part of an edge before the map's near plane.
    void add_edge(glm::dvec3 a, glm::dvec3 b, const glm::dvec2& slopes) {
        if (a.z > b.z) std::swap(a, b);
        if (b.z < near) return;
        if (a.z < near) a += (b - a) * ((near - a.z) / (b.z - a.z));
        for (const glm::dvec3& end : {a, b}) {
            const glm::dvec2 at = glm::dvec2(end) / (slopes * end.z);
            low_ = glm::min(low_, at), high_ = glm::max(high_, at);
        }
    }

    glm::dvec2 low_{std::numeric_limits<double>::infinity()}, high_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

std::uint32_t texels_a_side(const Light& light, std::span<const LightGrid> grids, MapTexels texels) {
    if (texels.per_cell <= 0) return texels.most;
    const glm::dvec2 slopes = pyramid_slopes(light);
    const double widest = std::max(slopes.x, slopes.y);
    double wanted = 16;
    for (const LightGrid& grid : grids) {
        if (grid.is_local && !injects(light, grid)) continue;
        const MappedBox box(grid);
        const double away = farthest_distance({box.low, box.high}, light.position);
        const double end = grid.is_local ? std::min(double(light.range), away) : double(light.range);
        wanted = std::max(wanted, texels.per_cell * widest * end / grid.cell);  // a map is as wide as that at half of the way
    }
    return std::uint32_t(std::min(8 * std::ceil(wanted / 8), double(texels.most)));
}

LightMaps maps_around(const View& view, const Light& light, std::span<const LightGrid* const> grids,
                      std::uint32_t texels_a_side) {
    const glm::dvec3 position = in_view_space(view, light.position);
    LightMaps maps{.size = texels_a_side, .light = glm::vec3(position), .range = light.range};
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, position)); };
    for (const LightPyramid& pyramid : light_pyramids(view, light)) {
        const Frustum frustum(pyramid.slopes, near);
        SeenPart part;
        for (const LightGrid* const grid : grids) {
            const MappedBox box(*grid);
            std::array<glm::dvec3, 8> corners = view_corners_of(view, {box.low, box.high});
            for (glm::dvec3& corner : corners) corner = seen_along(pyramid, position, corner);
            if (frustum.meets(corners)) part.add(corners, pyramid.slopes);
        }
        if (part.is_empty()) continue;
        maps.parts.push_back(part.texels(maps.size));
        maps.slopes = glm::vec2(pyramid.slopes);
        maps.views.push_back(
            rows(row(pyramid.u) / pyramid.slopes.x, row(pyramid.v()) / pyramid.slopes.y, {0, 0, 0, near}, row(pyramid.along)));
    }
    return maps;
}

namespace {

/// Texels of parallel light on the lattice of a grid's cells. On the plane that faces the axis nearest to the light they are
/// squares that are turned by 1 in n, so that n^2 + 1 of them make the square of a cell: a grid that is moved by whole cells has
/// the same texels in its cells, each texel of a cell lies at another height of a wall, and cells of a floor have equally many.
struct TexelLattice {
    glm::dvec3 along{0};  ///< as light goes
    glm::length_t facing = 0;
    double texel = 1;  ///< meters
    glm::dvec3 u{0},
        v{0};  ///< what a place is multiplied with: where light through it meets the plane through the world's origin

    TexelLattice(const glm::dvec3& direction, const MappedBox& box, std::uint32_t size, double most_per_cell)
        : along(glm::normalize(direction)) {
        for (const glm::length_t i : {1, 2})
            if (std::abs(along[i]) > std::abs(along[facing])) facing = i;
        const double narrowest = std::min(box.high[(facing + 1) % 3] - box.low[(facing + 1) % 3],
                                          box.high[(facing + 2) % 3] - box.low[(facing + 2) % 3]);
        double n = std::min(std::floor(size * box.cell / narrowest), most_per_cell);
        for (; n >= 1; --n)
            if (set(n, box.cell / std::hypot(n, 1.)); width(box) <= size * texel) return;
        // Fewer texels than cells: a whole number of cells makes a texel.
        for (n = 1; n <= 1024 && (set(0, n * box.cell), width(box) > size * texel); ++n) {}
    }
    /// Width of the map in meters, with a texel for its place on the lattice.
    double width(const MappedBox& box) const {
        return std::max(glm::dot(glm::abs(u), box.high - box.low), glm::dot(glm::abs(v), box.high - box.low)) + texel;
    }

private:
    /// n: 0 for texels along the axes.
    void set(double n, double width_of_texel) {
        texel = width_of_texel;
        const auto projection = [&](glm::length_t axis) {
            glm::dvec3 row(0);
            row[axis] = 1, row[facing] = -along[axis] / along[facing];
            return row;
        };
        const glm::dvec3 first = projection((facing + 1) % 3), second = projection((facing + 2) % 3);
        const glm::dvec2 turn = n > 0 ? glm::normalize(glm::dvec2(n, 1)) : glm::dvec2(1, 0);
        u = turn.x * first + turn.y * second, v = turn.x * second - turn.y * first;
    }
};

}  // namespace

LightMaps maps_over(const SceneFacts& facts, const View& view, const Light& light, const LightGrid& grid, MapTexels texels) {
    const MappedBox box(grid);
    const std::uint32_t most = parallel_map_scale * texels.most;
    const bool is_by_cells = texels.per_cell > 0;
    const double most_per_cell = is_by_cells ? std::ceil(parallel_map_scale * texels.per_cell) : most;
    const TexelLattice lattice(glm::dvec3(light.direction), box, most, most_per_cell);
    const double needed = is_by_cells ? 8 * std::ceil(lattice.width(box) / lattice.texel / 8) : most;
    const std::uint32_t size = needed < most ? std::uint32_t(needed) : most;  // of a direction that is no number, too
    const double half = .5 * size * lattice.texel;
    const auto row = [&](const glm::dvec3& axis, double shift) {
        const glm::dvec3 least = glm::min(axis * box.low, axis * box.high);
        const double corner = (std::floor((least.x + least.y + least.z) / lattice.texel - shift) + shift) * lattice.texel;
        return glm::dvec4(view.to_view * axis, glm::dot(view.origin, axis) - corner - half) / half;
    };
    glm::dvec4 x = row(lattice.u, map_shift_u), y = row(lattice.v, map_shift_v);
    if (lattice.along[lattice.facing] < 0) std::swap(x, y);  // front faces stay front faces
    const glm::dvec3 along = view.to_view * lattice.along, middle = in_view_space(view, .5 * (box.low + box.high));
    // A surface behind the grid may still light its last cells.
    const double behind = glm::dot(middle, along) + .5 * glm::length(box.high - box.low) + grid.cell;
    double deep = glm::length(box.high - box.low);
    for (const std::uint32_t caster : facts.lists().casters) {
        const Draw& draw = facts.frame().draws[caster];
        const BoundingSphere sphere = sphere_around(view, draw, facts.bounds().boxes[draw.mesh]);
        deep = std::max(deep, behind - glm::dot(sphere.center, along) + sphere.radius);
    }
    // A power of two times 1.0001: no caster is clipped for a rounded depth above 1, and none makes other depths of the others by
    // what the place of the frame's eye rounds.
    deep = 1.0001 * std::exp2(std::ceil(std::log2(deep) + 1e-3));
    return {.views = {rows(x, y, glm::dvec4(-along, behind) / deep, {0, 0, 0, 1})},
            .parts = {{.columns = {0, size}, .rows = {0, size}}},
            .size = size,
            .texel_area = float(lattice.texel * lattice.texel * std::abs(lattice.along[lattice.facing]))};
}

bool injects(const Light& light, const LightGrid& grid) {
    // Flux that is no number would be in the scale of all sums.
    if (!std::isfinite(most_flux(light, grid)) || strongest(light) <= 0) return false;
    if (!has_range(light.type)) return true;
    const MappedBox box(grid);
    return glm::distance(glm::clamp(light.position, box.low, box.high), light.position) < double(light.range);
}

double most_flux(const Light& light, const LightGrid& grid) {
    return strongest(light) * widest_side(light) * extent(light, grid);
}

MapImages draw_maps(Graph& graph, const FrameImages& frame, const LightMaps& maps, const LightEye& eye, DrawList casters) {
    const auto image = [&](std::string_view name, Format format) {
        Image made = graph.create(
            std::string(name),
            {.extent = {maps.size, maps.size}, .format = format, .layers = static_cast<std::uint32_t>(maps.views.size())});
        graph.clear(made, {});
        return made;
    };
    MapImages images{.position = image("lit positions", Format::rgba32f),
                     .normal = image("lit normals", Format::rgba16f),
                     .albedo = image("lit albedos", Format::rgba16f)};
    Image depth = image("depth of a light's map", Format::d32f);
    const std::uint32_t first = casters.first;
    for (std::uint32_t layer = 0; layer < maps.views.size() && casters.count > 0; ++layer) {
        casters.first = first + layer * casters.count;
        DrawStep draw = graph.draw("indirect/lpv/injection/map", casters);
        fix_materials(draw, frame, Surfaces::opaque)
            .covers(images.position, {.layer = layer})
            .covers(images.normal, {.layer = layer})
            .covers(images.albedo, {.layer = layer})
            .writes_depth(depth, {.layer = layer})
            .takes_first(eye.records)
            .in_rows(maps.parts[layer].rows)
            .in_columns(maps.parts[layer].columns)
            .push(maps.views[layer]);
    }
    return images;
}

}  // namespace strata::indirect
