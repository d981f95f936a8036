// Blur of what is not in focus (docs/algorithms/deferred.md 8.7).
#pragma once

#include "passes/frame_images.h"
#include "passes/lens/lens.shared.h"

namespace strata::lens {

/// FrameImages::color becomes what a lens with the recorded aperture sees. What is in focus keeps its bits.
void blur_by_depth(Graph&, FrameImages&, const LensParams&);

}  // namespace strata::lens
