// Where in its pixel a decoded position lies, as one number that a float holds exactly: the last channel of surface_material.
#pragma once

#include <glm/glm.hpp>

namespace strata {

/// Of an offset from the pixel's center, in pixels: x + 4096 y in steps of 1/4096 pixel, over 2^24. 0 is the center; offsets
/// beyond half a pixel become 2047 steps.
double place_code(const glm::dvec2& offset);
glm::dvec2 offset_of_place_code(double code);

}  // namespace strata
