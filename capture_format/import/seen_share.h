// How much of a frame's picture shows anything, without a device.
#pragma once

#include "capture_format/frame.h"

namespace strata {

/// The share of the picture that draws cover, counted at 64 x 36 points: alpha, culled faces and emitters do not count.
double seen_share(const Frame&);

}  // namespace strata
