// Surfels: every surface of a frame in small pieces, whether a light or the eye sees it or not.
#pragma once

#include <functional>
#include <string>

#include "passes/indirect/lpv/device_grid.h"

namespace strata::indirect {

/// Draws the opaque surfaces in and around a grid from along each axis, all of them on top of each other: three steps of a
/// fragment shader that includes passes/indirect/lpv/surfels/surfel.glsl. `finish` is called with each of them.
void draw_surfels(Graph&, const FrameImages&, const DeviceGrid&, const std::string& shader,
                  const std::function<void(DrawStep&)>& finish);

}  // namespace strata::indirect
