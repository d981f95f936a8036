// Brute force in double: it is what every light gives.
#include "passes/lighting/every_light.h"
#include "passes/technique.h"

namespace strata::lighting {

ImageSet brute_force_model(const StageInput& input, const Settings&) { return light_of_shaded_samples(input); }

}  // namespace strata::lighting
