// Traced shadows: one ray in double from every visible surface to every light that has a map.
#pragma once

#include "passes/stages.h"

namespace strata {

/// "visibility": 1 where nothing stands between, 0 where something does; layers as FrameImages::visibility. Empty when no
/// light has a map.
ImageSet shadows_truth(const StageInput&);

}  // namespace strata
