// Shadow maps by rays, for models and truths that are run without a device.
#pragma once

#include "passes/reference/image.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// A layer for each of shadow_views(), all of which are of one size: the depth of the nearest caster at a texel's center.
ReferenceImage traced_maps(const Frame&);

}  // namespace strata
