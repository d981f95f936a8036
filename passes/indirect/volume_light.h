// The light of a frame's volumes at any place, in double: of the cells that the stage indirect filled
// (FrameImages::volume_light), so that a stage that reads them is judged alone. Formulas: docs/algorithms/lighting.md 5.7
// and 5.8.
#pragma once

#include "passes/image_set.h"
#include "passes/reference/fragments.h"

namespace strata::indirect {

/// Of the volumes among a stage's inputs; empty where there are none.
LightAround volume_light(const Frame&, const ImageSet& before);

}  // namespace strata::indirect
