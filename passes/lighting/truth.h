// The truth of lighting: every light on every sample in double, area lights integrated, from the surfaces and the visibility that
// earlier stages gave, so that this stage is judged alone.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

ImageSet lighting_truth(const StageInput&);

}  // namespace strata
