// Exposure that follows the picture over frames (docs/algorithms/deferred.md 8.5).
#pragma once

#include "passes/graph/step.h"
#include "passes/lens/lens_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::lens {

/// Before the lens: FrameImages::exposure is what earlier frames left, as rgba32f (held.comp).
void recall_exposure(Graph&, FrameImages&);
/// Measures FrameImages::color and makes FrameImages::exposure the factor that this frame is shown with, one texel of r32f.
void adapt_exposure(Graph&, FrameImages&, const LensParams&);
/// A factor of 1.
void keep_exposure(Graph&, FrameImages&);

/// One row: mean luminance measured, the exposure it asks for, the frame's, and that of the frame before (0: there was none). A
/// luminance of 0 and factors of 1 where exposure does not adapt.
Image list_exposure(Graph&, const FrameImages&, const LensParams&);

}  // namespace strata::lens
