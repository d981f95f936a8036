#include "passes/reference/white_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"

namespace strata {
namespace {

constexpr double pi = std::numbers::pi;

double largest(const glm::vec3& color) {
    return double(std::max(std::abs(color.x), std::max(std::abs(color.y), std::abs(color.z))));
}

/// What an area light shows to a place before it, square meters; points show nothing.
double shown_area(const Light& light) {
    const double r = double(light.source_radius), u = double(light.half_extent.x), v = double(light.half_extent.y);
    switch (light.type) {
        case LightType::tube:
            return pi * r * r + 2 * u * 2 * r;
        case LightType::sphere:
        case LightType::disc:
            return pi * r * r;
        case LightType::rectangle:
            return 2 * u * 2 * v;
        default:
            return 0;
    }
}

double irradiance_within(const Light& light) {
    const double at_one = largest(light.intensity), distance = double(light.range) / 4;
    switch (light.type) {
        case LightType::directional:
            return at_one;
        case LightType::omni:
        case LightType::round_spot:
        case LightType::square_spot:
            return distance > 0 ? at_one / (distance * distance) : 0;
        default:
            return distance > 0 ? at_one * std::min(pi, shown_area(light) / (distance * distance)) : 0;
    }
}

}  // namespace

double white_radiance(const Frame& frame) {
    double irradiance = largest(frame.sun.irradiance);
    for (const Light& light : frame.lights) irradiance = std::max(irradiance, irradiance_within(light));
    const double fog = frame.fog.density > 0 ? largest(frame.fog.color) : 0;
    return std::max({irradiance / pi, largest(frame.hemisphere.sky), largest(frame.hemisphere.ground), fog});
}

}  // namespace strata
