// The march in double, which asks the map at every step: bounds may change nothing.
#include "passes/stage_input.h"
#include "passes/sun_shafts/march_model.h"

namespace strata::sun_shafts {

ImageSet ray_march_min_max_model(const StageInput& input, const Settings& settings) { return march_model(input, settings); }

}  // namespace strata::sun_shafts
