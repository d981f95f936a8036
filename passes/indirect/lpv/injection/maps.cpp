#include "passes/indirect/lpv/injection/maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
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
    if (!has_range(light.type)) return std::pow(2 * radius(grid), 2);
    const double round = facts_of(light.type).cone == LightCone::round ? 1 - std::cos(double(light.outer_angle)) : 2;
    return 2 * std::numbers::pi * round;
}

}  // namespace

LightMaps maps_around(const Frame& frame, const Light& light) {
    LightMaps maps;
    const glm::dvec3 position = in_view_space(frame.view, light.position);
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, position)); };
    constexpr double near = .05;  // meters; depth is reversed and infinite, so that it costs nothing to be near
    for (const LightPyramid& pyramid : light_pyramids(frame, light)) {
        maps.slopes = glm::vec2(pyramid.slopes);
        maps.views.push_back(
            rows(row(pyramid.u) / pyramid.slopes.x, row(pyramid.v()) / pyramid.slopes.y, {0, 0, 0, near}, row(pyramid.along)));
    }
    return maps;
}

LightMaps maps_over(const SceneFacts& facts, const Light& light, const LightGrid& grid, std::uint32_t size) {
    const Frame& frame = facts.frame();
    const ParallelAxes axes = parallel_axes(glm::dvec3(light.direction));
    const double half = radius(grid), texel = 2 * half / size;
    const glm::dvec3 middle = grid.origin + .5 * grid.cell * glm::dvec3(grid.cells);
    const auto row = [&](const glm::dvec3& axis) {
        const double corner = std::floor((glm::dot(middle, axis) - half) / texel) * texel;
        const glm::dvec3 in_view = frame.view.to_view * axis;
        return glm::dvec4(in_view, glm::dot(frame.view.origin, axis) - corner - half) / half;
    };
    const glm::dvec3 along = frame.view.to_view * axes.along;
    // A surface behind the grid may still light its last cells.
    const double behind = glm::dot(in_view_space(frame.view, middle), along) + half + grid.cell;
    double before = behind - 2 * half;
    for (const std::uint32_t draw : facts.lists().casters) {
        const BoundingSphere& caster = facts.bounds().spheres[draw];
        before = std::min(before, glm::dot(caster.center, along) - caster.radius);
    }
    before -= 1e-3 * (behind - before);  // so that no caster is clipped for a rounded depth above 1
    return {.views = {rows(row(axes.u), row(axes.v), glm::dvec4(-along, behind) / (behind - before), {0, 0, 0, 1})},
            .texel_area = float(texel * texel)};
}

bool injects(const Light& light, const LightGrid& grid) {
    // Flux that is no number would be in the scale of all sums.
    if (!std::isfinite(most_flux(light, grid)) || strongest(light) <= 0) return false;
    if (!has_range(light.type)) return true;
    // A surface may be a cell beside the cell that it lights.
    const glm::dvec3 low = grid.origin - grid.cell, high = grid.origin + (glm::dvec3(grid.cells) + 1.) * grid.cell;
    return glm::distance(glm::clamp(light.position, low, high), light.position) < double(light.range);
}

double most_flux(const Light& light, const LightGrid& grid) {
    return strongest(light) * widest_side(light) * extent(light, grid);
}

MapImages draw_maps(Graph& graph, const FrameImages& frame, const LightMaps& maps, std::uint32_t size) {
    const auto image = [&](std::string_view name, Format format) {
        Image made =
            graph.create(std::string(name),
                         {.extent = {size, size}, .format = format, .layers = static_cast<std::uint32_t>(maps.views.size())});
        graph.clear(made, {});
        return made;
    };
    MapImages images{.position = image("lit positions", Format::rgba32f),
                     .normal = image("lit normals", Format::rgba16f),
                     .albedo = image("lit albedos", Format::rgba16f)};
    Image depth = image("depth of a light's map", Format::d32f);
    for (std::uint32_t layer = 0; layer < maps.views.size(); ++layer) {
        DrawStep draw = graph.draw("indirect/lpv/injection/map", frame.casters);
        fix_materials(draw, frame, Surfaces::opaque)
            .covers(images.position, {.layer = layer})
            .covers(images.normal, {.layer = layer})
            .covers(images.albedo, {.layer = layer})
            .writes_depth(depth, {.layer = layer})
            .push(maps.views[layer]);
    }
    return images;
}

}  // namespace strata::indirect
