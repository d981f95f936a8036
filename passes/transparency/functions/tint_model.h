// Color where T(z) has one channel, in double: see tint.glsl.
#pragma once

#include "passes/reference/fragments.h"
#include "passes/transparency/functions/function.shared.h"

namespace strata::transparency {

/// What a fragment adds to the depths of red and blue beyond that of green. seen: T(z), fogged.
glm::dvec2 skew_depths(const Fragment&, double seen);

/// What all that is drawn is multiplied by; its luminance is 1.
glm::dvec3 skew(glm::dvec2 depths);

}  // namespace strata::transparency
