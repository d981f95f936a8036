// The truth of the G-buffer: attributes of the nearest opaque surface at every sample's own position, unrounded.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

ImageSet gbuffer_truth(const StageInput&);

}  // namespace strata
