// Emitters of a frame and their particles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/glm_types.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/no_index.h"

namespace strata {

/// One camera-facing quad. Its corners are center +- size, turned by rotation around the view axis.
struct Particle {
    glm::dvec3 center{0};  ///< world
    float size = 1;        ///< half the edge, meters
    float rotation = 0;    ///< radians, counter-clockwise on screen
    glm::vec3 color{1};    ///< unpremultiplied scattered radiance, already lit by all but light volumes
    float alpha = 1;
    glm::vec3 emissive{0};           ///< radiance added without coverage
    glm::vec4 uv_frame{0, 0, 1, 1};  ///< left, top, width, height of the flipbook cell
    float depth_offset = 0;          ///< meters towards the eye, for sorting and blending, not for the depth test
};

struct Emitter {
    std::string name;
    std::uint32_t texture = no_index;  ///< rgb multiplies color and emissive, a multiplies alpha
    AlphaMode alpha_mode = AlphaMode::blend;
    float soft_depth_fade = 0;  ///< meters over which a quad fades before the opaque surface behind it; 0 is hard
    std::int32_t sort_priority = 0;
    Resolution resolution = Resolution::full;
    std::uint32_t layer = 0;
    std::vector<Particle> particles;
};

}  // namespace strata
