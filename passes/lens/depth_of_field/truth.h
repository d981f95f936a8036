// What a thin lens makes of a picture with depth, by its definition.
#pragma once

#include "passes/reference/image.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::lens {

/// The mean of pictures seen from `places` points of the lens, evenly over its disc: a ray from each meets the surface that the
/// picture's depths are. What the picture hides is not known to it: where a ray goes behind the surface for good, the pixel
/// before which it last was goes on. Samples that are not numbers do not count.
ReferenceImage seen_through_lens(const StageInput&, const ReferenceImage& color, std::uint32_t places = 256);

}  // namespace strata::lens
