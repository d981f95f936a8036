// The technique in double precision, from the paper and not from the shader.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/weighted/weighted.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// Weight of a fragment; coverage is 1 - mean(t). `near` is the near plane's distance, for w10.
double weight_in_double(const WeightedParams&, double near, const Fragment&);

/// One sample: the weighted average over what shows through, with sums in double.
glm::dvec3 weighted_blend(std::span<const Fragment>, glm::dvec3 behind, const WeightedParams&, double near);

ImageSet weighted_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
