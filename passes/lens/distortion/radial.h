// Straight lines that a lens bends (docs/algorithms/deferred.md 8.8).
#pragma once

#include "passes/frame_images.h"
#include "passes/lens/lens.shared.h"

namespace strata::lens {

/// The factor on the whole picture that shows nothing from beyond its border.
double radial_scale(double k1, double width, double height);

/// FrameImages::color becomes what a lens with k1 shows.
void distort(Graph&, FrameImages&, const LensParams&);

}  // namespace strata::lens
