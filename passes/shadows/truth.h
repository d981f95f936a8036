// Traced shadows: rays in double from every visible surface to every light that has a map: one, or 256 over the source of a soft
// one.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// "visibility": the share of the light's source that nothing stands before, of a soft light any, else 0 or 1. A soft spot's
/// source is a disc across its direction, an omni light's a sphere, the sun's a cone. Layers as FrameImages::visibility. Empty
/// when no light has a map.
ImageSet shadows_truth(const StageInput&);

}  // namespace strata
