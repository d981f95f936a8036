// Marched sun shafts in double, over the shadow maps as the device drew them: what the models of the stage's techniques are.
#pragma once

#include "passes/image_set.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::sun_shafts {

/// "shafts" at settings of march_params().
ImageSet march_model(const StageInput&, const Settings&);

}  // namespace strata::sun_shafts
