// Surfaces in the way of light between cells.
#pragma once

#include "passes/indirect/lpv/device_grid.h"

namespace strata::indirect {

/// Makes later_links of a grid that is_fuzzy, of its links and of all opaque surfaces.
void find_fuzzy_links(Graph&, const FrameImages&, DeviceGrid&);

}  // namespace strata::indirect
