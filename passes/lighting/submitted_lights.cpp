#include "passes/lighting/submitted_lights.h"

#include "passes/shadows/shadow_views.h"

namespace strata::lighting {

std::vector<Light> submitted_lights(const Frame& frame) { return shadow_lights(frame); }

}  // namespace strata::lighting
