// The truth of the lens, in double: exposure by its formula, a thin lens by its definition, distortion by the polynomial, bloom
// as a sum of Gaussians. What is behind what the picture shows is not known to it, and transparent layers blur as what is behind
// them.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// exposure where it adapts, and color where the lens blurs, bends or glows; at the default settings of techniques.
ImageSet lens_truth(const StageInput&);

}  // namespace strata
