// Sorted blending in double, from far to near as a painter would; the truth goes from near to far.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// One sample's fragments in submission order: sorted (of equal depths the later submission is nearer), L = p + e + t L.
glm::dvec3 sorted_blend(std::span<const Fragment>, glm::dvec3 behind);

ImageSet sorted_lists_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
