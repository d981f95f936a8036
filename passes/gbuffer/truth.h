// The truth of the G-buffer: attributes of the nearest opaque surface at every sample's own position, unrounded.
#pragma once

#include "passes/stages.h"

namespace strata {

ImageSet gbuffer_truth(const StageInput&);

}  // namespace strata
