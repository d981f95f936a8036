#include "passes/reference/place_code.h"

#include <cmath>

namespace strata {
namespace {

constexpr double steps_per_pixel = 4096, most_steps = 2047, scale = 0x1p24;

}  // namespace

double place_code(const glm::dvec2& offset) {
    const glm::dvec2 steps = glm::clamp(glm::floor(offset * steps_per_pixel + 0.5), -most_steps, most_steps);
    return (steps.x + steps_per_pixel * steps.y) / scale;
}

glm::dvec2 offset_of_place_code(double code) {
    // x is below half a step of y.
    const double y = std::nearbyint(code * scale / steps_per_pixel), x = code * scale - y * steps_per_pixel;
    return glm::dvec2(x, y) / steps_per_pixel;
}

}  // namespace strata
