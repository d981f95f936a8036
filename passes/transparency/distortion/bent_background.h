// Materials that distort what is behind them (docs/algorithms/transparency.md 6.13): the background is seen sum d_i T(z_i) away,
// d_i in uv. A technique with a T(z) of its own adds the offsets with it and reads undistorted(); the others call
// distort_background(). Of a frame where nothing distorts nothing is declared.
#pragma once

#include "passes/graph/step.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::transparency {

/// A copy of images.color to read at other places while it is written; no image where nothing distorts.
Image undistorted(Graph&, const FrameImages&);

/// Bends images.color before a technique blends over it, with T(z) as alpha blending by object finds it: wrong where that is
/// wrong.
void distort_background(Graph&, FrameImages&);

}  // namespace strata::transparency
