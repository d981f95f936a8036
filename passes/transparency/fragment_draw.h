// The draw of transparent geometry as every technique does it: tested against opaque depth, with what fragment.glsl declares
// bound.
#pragma once

#include <string>
#include <vector>

#include "capture_format/frame/draw.h"
#include "passes/graph/graph.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h

/// Declares a draw of `list` with a fragment shader that includes passes/transparency/fragment.glsl. Chain the technique's own
/// verbs.
DrawStep draw_fragments(Graph&, std::string shader, const DrawList& list, const FrameImages&);
/// The same without the test, for a technique with a depth of its own: `depth_layers` is bound whether the frame needs it or not.
DrawStep draw_fragments_untested(Graph&, std::string shader, const DrawList& list, const FrameImages&);

/// The side of transparent triangles that no draw of the frame shows. The shader leaves backs out draw by draw; a pipeline that
/// culls them spares their fragments.
Cull hidden_side(const FrameImages&);

/// The transparent draws of one resolution: stretches of images.transparent, most often all of it or nothing.
std::vector<DrawList> drawn_at(const FrameImages&, Resolution);

/// The image read by sample, named for it; no image of none.
Image by_sample(Graph&, const Image&);

}  // namespace strata
