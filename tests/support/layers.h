// Fragments for facts about blending: one gray layer of a pixel.
#pragma once

#include "passes/reference/fragments.h"

namespace strata {

/// Unpremultiplied color.
inline Fragment layer(double depth, double alpha, double color) {
    return {.depth = depth, .color = glm::dvec3(alpha * color), .transmittance = glm::dvec3(1 - alpha), .alpha = alpha};
}

}  // namespace strata
