// The draw of transparent geometry as every technique does it: tested against opaque depth, with what event.glsl declares bound.
#pragma once

#include <string>
#include <vector>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"

namespace strata {

/// Declares a draw of `list` with a fragment shader that includes passes/transparency/event.glsl. Chain the technique's own
/// verbs.
DrawPass draw_events(Graph&, std::string shader, const DrawList& list, const FrameImages&);
/// The same without the test, for a technique with a depth of its own: `depth_layers` is bound whether the frame needs it or not.
DrawPass draw_events_untested(Graph&, std::string shader, const DrawList& list, const FrameImages&);

/// The side of transparent triangles that no draw of the frame shows. The shader leaves backs out draw by draw; a pipeline that
/// culls them spares their fragments.
Cull hidden_side(const FrameImages&);

/// The transparent draws of one resolution: stretches of images.transparent, most often all of it or nothing.
std::vector<DrawList> drawn_at(const FrameImages&, Resolution);

/// The image read by sample, named for it; no image of none.
Image by_sample(Graph&, const Image&);

}  // namespace strata
