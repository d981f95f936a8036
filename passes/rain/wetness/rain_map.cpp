#include "passes/rain/wetness/rain_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "passes/scene/light_pyramids.h"

namespace strata::rain {
namespace {

/// The sphere around the view's pyramid up to a depth, on the view axis: through the eye and the far corners, or around the far
/// corners where the pyramid is so wide that this is smaller.
BoundingSphere view_sphere(const View& view, double reach) {
    const double x = (1 + std::abs(double(view.projection[2][0]))) / std::abs(double(view.projection[0][0]));
    const double y = (1 + std::abs(double(view.projection[2][1]))) / std::abs(double(view.projection[1][1]));
    const double k = x * x + y * y, center = reach * std::min(1.0, 0.5 * (1 + k));
    return {{0, 0, center}, std::max(center, std::hypot(std::sqrt(k) * reach, reach - center))};
}

/// Texels at each border: taps reach so far outside, from places moved as far along a wall's normal; one is for the steps.
double margin(const RainMapShape& shape) { return std::min(2 * shape.radius + 3, shape.size / 4.0); }

}  // namespace

std::vector<glm::dvec3> rain_directions(const glm::dvec3& recorded, std::uint32_t count, double spread) {
    if (count <= 1) return {recorded};
    const ParallelAxes axes = parallel_axes(recorded);
    std::vector<glm::dvec3> directions;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double around = 2 * std::numbers::pi * i / count;
        directions.push_back(axes.along * std::cos(spread) +
                             (axes.u * std::cos(around) + axes.v * std::sin(around)) * std::sin(spread));
    }
    return directions;
}

RainMap rain_map(const Frame& frame, std::span<const BoundingSphere> casters, const RainMapShape& shape) {
    return rain_map_along(glm::dvec3(frame.rain.direction), frame, casters, shape);
}

RainMap rain_map_along(const glm::dvec3& direction, const Frame& frame, std::span<const BoundingSphere> casters,
                       const RainMapShape& shape) {
    const BoundingSphere seen = view_sphere(frame.view, shape.reach);
    const double texel = 2 * seen.radius / (shape.size - 2 * margin(shape));
    const ParallelAxes axes = parallel_axes(direction);
    const auto row = [&](const glm::dvec3& axis) {
        const glm::dvec3 in_view = frame.view.to_view * axis;
        const double eye = glm::dot(frame.view.origin, axis);
        const double center = std::round((glm::dot(seen.center, in_view) + eye) / texel) * texel;
        return glm::dvec4(in_view, eye - center + 0.5 * shape.size * texel) / texel;
    };
    const glm::dvec3 along = frame.view.to_view * axes.along;
    double first = glm::dot(seen.center, along) - seen.radius, last = first + 2 * seen.radius;
    for (const BoundingSphere& caster : casters) {
        first = std::min(first, glm::dot(caster.center, along) - caster.radius);
        last = std::max(last, glm::dot(caster.center, along) + caster.radius);
    }
    first -= 1e-3 * (last - first);  // so that no caster is clipped for a rounded depth above 1
    return {.u = row(axes.u),
            .v = row(axes.v),
            .depth = glm::dvec4(-along, last) / (last - first),
            .texel = texel,
            .range = last - first,
            .towards_rain = -along};
}

}  // namespace strata::rain
