// What all G-buffer techniques declare alike: the raster step over the visible opaque draws into depth, two targets and emission.
#pragma once

#include <string_view>

#include "passes/frame_images.h"

namespace strata::gbuffer {

/// Draws frame.opaque with "<technique>/fill" into gbuffer0 (rgba16f), gbuffer1 (rgba8) and emission (rgba16f), with depth
/// writes, into frame.depth where an earlier stage has drawn into it what hides them, and leaves their own depth there; spreads
/// samples into layers, tells readers the layout and declares the decoded surfaces.
void add_fill(Graph&, FrameImages&, std::string_view technique);

}  // namespace strata::gbuffer
