// A surface point from the decoded images of a G-buffer: what stages after it start from, in double.
#pragma once

#include "passes/reference/shade.h"

namespace strata {

/// One texel of surface_normal, surface_color and surface_material.
struct DecodedTexels {
    glm::dvec4 normal{0}, color{0}, material{0};
};

/// The position lies where the last channel of surface_material says (place_code.h), as readers of a G-buffer have it.
SurfacePoint decoded_surface(const Frame&, const DecodedTexels&, std::uint32_t x, std::uint32_t y);

}  // namespace strata
