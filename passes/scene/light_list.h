// The lights that the device is given.
#pragma once

#include <vector>

#include "capture_format/frame.h"

namespace strata {

/// In the order of the device's records: the sun as a directional light when it shines, then those of Frame::lights that do. A
/// light of no intensity or range is not on the list.
std::vector<Light> light_list(const Frame&);

/// Whether a light has intensity and, unless it is directional, range.
bool shines(const Light&);
bool shines(const Sun&);

}  // namespace strata
