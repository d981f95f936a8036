// Which of a frame's lights there are, and which of them have shadow maps, as references derive it.
#pragma once

#include <cstdint>
#include <vector>

#include "capture_format/frame/light.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// Lights that can add light to anything: the sun first, unless it is black, then the frame's, without those that are black or,
/// unless directional, reach nowhere. Images with a layer per light have this order.
std::vector<Light> shining_lights(const Frame&);

/// Places in shining_lights() of those that cast shadows by maps: the sun, spots, omni lights and spheres. The k-th of them has
/// the k-th layers of "visibility".
std::vector<std::uint32_t> mapped_lights(const Frame&);

}  // namespace strata
