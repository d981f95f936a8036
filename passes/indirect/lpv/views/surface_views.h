// Pictures of what surfaces read of grids.
#pragma once

#include "passes/graph/step.h"

namespace strata {

class Graph;         // passes/graph/graph.h
class Settings;      // passes/settings.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::indirect {

Image visible_taps(Graph&, FrameImages&, const Settings&);
Image near_blockers(Graph&, FrameImages&, const Settings&);
Image lighting_volume(Graph&, FrameImages&, const Settings&);

}  // namespace strata::indirect
