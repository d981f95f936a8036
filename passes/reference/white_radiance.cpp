#include "passes/reference/white_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"

namespace strata {
namespace {

constexpr double pi = std::numbers::pi;

double largest(const glm::vec3& color) {
    return double(std::max(std::abs(color.x), std::max(std::abs(color.y), std::abs(color.z))));
}

/// Area that a light shows to a place before it, square meters.
double shown_area(const Light& light, LightShape shape) {
    const double r = double(light.source_radius), u = double(light.half_extent.x), v = double(light.half_extent.y);
    if (shape == LightShape::rectangle) return 2 * u * 2 * v;
    return pi * r * r + (shape == LightShape::tube ? 2 * u * 2 * r : 0);
}

double irradiance_within(const Light& light) {
    const LightShape shape = facts_of(light.type).shape;
    const double at_one = largest(light.intensity), distance = double(light.range) / 4;
    if (shape == LightShape::parallel) return at_one;
    if (!(distance > 0)) return 0;
    const double per_intensity =
        shape == LightShape::point ? 1 / (distance * distance) : std::min(pi, shown_area(light, shape) / (distance * distance));
    return at_one * per_intensity;
}

}  // namespace

double white_radiance(const Frame& frame) {
    double irradiance = largest(frame.sun.irradiance);
    for (const Light& light : frame.lights) irradiance = std::max(irradiance, irradiance_within(light));
    const double fog = frame.fog.density > 0 ? largest(frame.fog.color) : 0;
    return std::max({irradiance / pi, largest(frame.hemisphere.sky), largest(frame.hemisphere.ground), fog});
}

}  // namespace strata
