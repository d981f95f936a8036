// A frame of one pixel with nothing in it, for models that compute a pixel from the images before them.
#pragma once

#include <cstdint>

#include "capture_format/frame/frame.h"

namespace strata {

/// The eye at the origin looks along +z; half the height is 1 at z = 1.
Frame one_pixel(std::uint32_t samples);

}  // namespace strata
