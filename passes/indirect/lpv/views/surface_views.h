// Pictures of what surfaces read of grids.
#pragma once

#include "passes/technique.h"

namespace strata::indirect {

Image visible_taps(Graph&, FrameImages&, const Settings&);
Image near_blockers(Graph&, FrameImages&, const Settings&);
Image lighting_volume(Graph&, FrameImages&, const Settings&);

}  // namespace strata::indirect
