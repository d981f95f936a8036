// A frame of triangles placed by pixel, each a surface of its own, in the light of one sun without shadow: for facts about
// samples.
#pragma once

#include <array>
#include <span>

#include "capture_format/frame.h"

namespace strata {

/// Corners: pixels from the upper left, and view depth in meters.
struct PixelTriangle {
    std::array<glm::dvec3, 3> corners;
    glm::vec3 color{0.5f};
    glm::vec3 emissive{0};
};

/// A triangle over more than the picture, at one depth.
PixelTriangle whole_picture(glm::uvec2 extent, double depth, glm::vec3 color = glm::vec3(0.5f));

/// The part of whole_picture() to the right of a column, which need not be whole.
PixelTriangle right_of(glm::uvec2 extent, double column, double depth, glm::vec3 color);

Frame frame_of_triangles(glm::uvec2 extent, std::uint32_t samples, std::span<const PixelTriangle>);

}  // namespace strata
