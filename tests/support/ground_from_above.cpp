#include "tests/support/ground_from_above.h"

#include <cmath>

namespace strata {

Frame ground_from_above(std::uint32_t width, std::uint32_t rows, double wide) {
    Frame frame;
    frame.view.width = width;
    frame.view.height = rows;
    frame.view.origin = {0, height_above_ground, 0};
    frame.view.to_view = glm::transpose(glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, -1, 0}));
    const double half_angle = std::atan(0.5 * wide / height_above_ground * rows / width);
    frame.view.projection = perspective(2 * half_angle, double(width) / rows, 0.1);
    return frame;
}

void add_slanted_sun(Frame& frame, double angle, std::uint32_t map_size) {
    frame.sun.direction = {float(std::sin(angle)), float(-std::cos(angle)), 0};
    frame.sun.irradiance = {1, 1, 1};
    frame.sun.cascades = 1;
    frame.sun.shadow_distance = 20;
    frame.sun.shadow = {.casts = true, .map_size = map_size, .bias = 0.01f};
}

}  // namespace strata
