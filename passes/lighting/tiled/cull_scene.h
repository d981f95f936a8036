// A recorded frame as culling reads it, made on the CPU from the formulas of capture_format/frame.h.
#pragma once

#include "capture_format/frame.h"
#include "passes/lighting/tiled/cull_mirror.h"

namespace strata::lighting {

/// Lights in the order of the device's list. Features are left out: a model has no shading modes.
CullScene cull_scene(const Frame&);

}  // namespace strata::lighting
