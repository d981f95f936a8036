// Where a device may cut a triangle into pieces: clipping to the view leaves a polygon, which is drawn as triangles. lavapipe
// clips at the picture's border, without a guard band.
#pragma once

#include <vector>

#include "capture_format/frame.h"

namespace strata::edges {

/// Pixels, row by row, on a line between two corners of what the view leaves of an opaque triangle that it cuts: whichever way
/// the polygon is divided, its seams are among these lines.
std::vector<bool> pixels_on_clip_seams(const Frame&);

}  // namespace strata::edges
