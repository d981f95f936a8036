// The lights of a frame as lighting techniques get them, and what shading them may need.
#pragma once

#include <cstdint>
#include <vector>

#include "capture_format/frame.h"

namespace strata::lighting {

/// The sun first when it shines, then Frame::lights: the order of the device's light list.
std::vector<Light> submitted_lights(const Frame&);

}  // namespace strata::lighting
