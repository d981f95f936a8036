// Middles of cells on the planes of blockers.
#pragma once

#include "capture_format/frame.h"
#include "passes/scene/light_grids.h"

namespace strata::indirect {

/// Whether the middle of a cell beside a blocker lies so near its plane that rounding, and with it the eye's place, decides on
/// which side it is. Light that another eye injected and propagated would then be read through the blocker.
bool has_middle_on_a_plane(const Frame&, const LightGrid&);

}  // namespace strata::indirect
