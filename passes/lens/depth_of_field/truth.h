// What a thin lens makes of a picture with depth, by its definition.
#pragma once

#include "passes/stages.h"

namespace strata::lens {

/// The mean of pictures seen from `places` points of the lens, evenly over its disc. From each, a sample moves by its blur times
/// the place's offset and hides what is farther; where nothing falls, the farther of what lies beside the gap goes on. What the
/// picture hides is not known to it.
ReferenceImage seen_through_lens(const StageInput&, const ReferenceImage& color, std::uint32_t places = 256);

}  // namespace strata::lens
