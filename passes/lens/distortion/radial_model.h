// Radial distortion in double.
#pragma once

#include "passes/reference/image.h"

namespace strata::lens {

/// Four texels of a layer around a place in pixels, the border held; 0 to 65504, and 0 of what is not a number.
glm::dvec3 bilinear(const ReferenceImage&, glm::dvec2 at, std::uint32_t layer);

/// Where in the picture of a lens without distortion a place of the distorted one lies, in pixels.
glm::dvec2 radial_source(double k1, glm::dvec2 at, glm::dvec2 extent);

ReferenceImage radial_model(const ReferenceImage& color, double k1);

}  // namespace strata::lens
