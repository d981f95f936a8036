// Straight lines that a lens bends (docs/algorithms/deferred.md 8.8).
#pragma once

#include "passes/lens/lens_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::lens {

/// The factor on the whole picture that shows nothing from beyond its border.
double radial_scale(double k1, double width, double height);

/// FrameImages::color becomes what a lens with k1 shows.
void distort(Graph&, FrameImages&, const LensParams&);

}  // namespace strata::lens
