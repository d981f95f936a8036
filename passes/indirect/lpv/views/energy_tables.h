// The energy of light in grids, as tables.
#pragma once

#include "passes/graph/step.h"

namespace strata {

class Graph;         // passes/graph/graph.h
class Settings;      // passes/settings.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::indirect {

/// By step of propagation: W that the first grid's cells hold, that blockers absorbed so far, and that left the grid so far.
Image energy_table(Graph&, FrameImages&, const Settings&);
/// By bounce of the light: W that surfaces inject into the first grid.
Image bounces_table(Graph&, FrameImages&, const Settings&);

}  // namespace strata::indirect
