// A recorded frame as culling reads it.
#pragma once

#include "passes/lighting/tiled/cull_mirror.h"

namespace strata::lighting {

/// Lights in the order of the device's list. Shadows are left out: a model has no shading modes.
CullScene cull_scene(const Frame&);

}  // namespace strata::lighting
