// The technique in double: culling loses nothing, so it is every light on every sample that is shaded.
#include "passes/lighting/every_light.h"
#include "passes/stage_input.h"

namespace strata::lighting {

ImageSet z_binned_model(const StageInput& input, const Settings&) { return light_of_shaded_samples(input); }

}  // namespace strata::lighting
