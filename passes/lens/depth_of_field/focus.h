// Blur of what is not in focus (docs/algorithms/deferred.md 8.7).
#pragma once

#include "passes/graph/step.h"
#include "passes/lens/lens_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::lens {

/// Whether a frame has blur at these settings.
bool blurs(const FrameImages&, const LensParams&);

/// FrameImages::color becomes what a lens with the recorded aperture sees. What is in focus keeps its bits.
void blur_by_depth(Graph&, FrameImages&, const LensParams&);

/// Radius of the circle of confusion of each pixel's first sample in pixels, negative before the plane in focus; of X-Ray's
/// ellipse of taps, its width. 0 where nothing blurs.
Image show_blur(Graph&, const FrameImages&, const LensParams&);
/// How many taps give light to it: before its surface, on it, behind it. 0 where nothing blurs.
Image show_taps(Graph&, const FrameImages&, const LensParams&);

}  // namespace strata::lens
