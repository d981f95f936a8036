// The G-buffer decoded into float images, for whoever asks: reports, models, debug views.
#pragma once

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::gbuffer {

/// Declares frame.surface_normal, surface_color and surface_material from the G-buffer; culled when nobody keeps them.
void add_surfaces(Graph&, FrameImages&);

/// Lets later stages read those three images in the place of the technique's own: they may have been given.
void read_surfaces(FrameImages&);

}  // namespace strata::gbuffer
