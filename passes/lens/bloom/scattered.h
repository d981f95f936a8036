// The glow that a lens without a pyramid makes: a sum of Gaussians.
#pragma once

#include "passes/reference/image.h"

namespace strata::lens {

/// The mean of `levels` Gaussians over a picture with its border held, of variances (4^l - 1) / 2 squared pixels for l = 1 ..
/// levels: those that a pyramid of tent filters has. Gain 1.
ReferenceImage scattered(const ReferenceImage& glowing, std::uint32_t levels);

}  // namespace strata::lens
