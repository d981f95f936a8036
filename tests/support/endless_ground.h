// A ground that is seen up to its horizon, under uniform light: what errors of depth far away show on.
#pragma once

#include "capture_format/frame.h"

namespace strata {

/// The plane y = 0 of a kilometer each way, Lambert, under a sky and a ground of radiance 1.
Frame endless_ground(const Camera&, std::uint32_t samples);

}  // namespace strata
