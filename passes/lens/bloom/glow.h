// Light that a lens scatters around what is bright (docs/algorithms/deferred.md 8.6).
#pragma once

#include "passes/graph/step.h"
#include "passes/lens/lens_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::lens {

/// Halvings of the picture that make its widest glow about `reach` of its height in standard deviation; 1 to 12.
std::uint32_t glow_levels(double reach, std::uint32_t height);

/// Whether a frame has a glow at these settings.
bool glows(const FrameImages&, const LensParams&);

/// Adds the glow of FrameImages::color to it, every sample of a pixel alike.
void add_bloom(Graph&, FrameImages&, const LensParams&);

/// What was added to each pixel, as radiance; 0 where nothing glows.
Image show_glow(Graph&, const FrameImages&, const LensParams&);

}  // namespace strata::lens
