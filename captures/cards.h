// Frames of unlit squares that face the eye: layers whose blend can be computed by hand. The eye is at the origin, world
// space is view space, the field of view is 90 degrees, so that a card of half size z at depth z fills the image.
#pragma once

#include <span>

#include "capture_format/frame/material.h"

namespace strata {

struct Frame;  // capture_format/frame.h

struct Card {
    glm::dvec3 center{0, 0, 1};
    float half = 10;
    glm::vec4 color{1};  ///< unpremultiplied radiance and coverage
    double tilt = 0;     ///< radians around the vertical axis
    std::int32_t sort_priority = 0;
    AlphaMode alpha_mode = AlphaMode::blend;
    float distortion = 0;       ///< uv per unit of the normal, which a tilt turns
    glm::vec3 transmission{0};  ///< as Material::transmission
};

/// Width = height = extent, black background, one draw per card in the given order.
Frame frame_of_cards(std::span<const Card>, std::uint32_t extent);

}  // namespace strata
