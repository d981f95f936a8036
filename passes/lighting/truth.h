// The truth of lighting: every light on every sample in double, area lights integrated, from the surfaces and the visibility that
// earlier stages gave, so that this stage is judged alone.
#pragma once

#include "passes/stages.h"

namespace strata {

ImageSet lighting_truth(const StageInput&);

}  // namespace strata
