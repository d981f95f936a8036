// The lights of a frame as lighting techniques get them, and what shading them may need.
#pragma once

#include <cstdint>
#include <vector>

#include "capture_format/frame.h"

namespace strata::lighting {

/// The sun first when it shines, then Frame::lights: the order of the device's light list.
std::vector<Light> submitted_lights(const Frame&);

/// Bits of passes/shaders/light_features.shared.h that any light or surface of the frame may need: nothing that a tile finds is
/// outside them.
std::uint32_t frame_spectrum(const Frame&);

}  // namespace strata::lighting
