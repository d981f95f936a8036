// The energy of light in grids, as tables.
#pragma once

#include "passes/technique.h"

namespace strata::indirect {

/// By step of propagation: W that the first grid's cells hold, that blockers absorbed so far, and that left the grid so far.
Image energy_table(Graph&, FrameImages&, const Settings&);
/// By bounce of the light: W that surfaces inject into the first grid.
Image bounces_table(Graph&, FrameImages&, const Settings&);

}  // namespace strata::indirect
