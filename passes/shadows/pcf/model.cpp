// Percentage-closer filtering in double, by brute force over the maps as they were drawn.
#include "passes/settings.h"
#include "passes/shadows/lookup.h"
#include "passes/shadows/shadow_map_params.h"
#include "passes/stage_input.h"

namespace strata::shadows {

ImageSet pcf_model(const StageInput& input, const Settings& settings) {
    return visibility_model(input, settings.as<ShadowMapParams>().filter, fixed_lookup);
}

}  // namespace strata::shadows
