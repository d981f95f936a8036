// The technique in double precision.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/depth_peeling/depth_peeling.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// One sample, its fragments in submission order. `near` is the near plane's distance: nothing is before it.
glm::dvec3 peeled_blend(std::span<const Fragment>, glm::dvec3 behind, std::uint32_t passes, double near);

ImageSet depth_peeling_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
