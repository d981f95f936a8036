// The lights that the device is given.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/frame/light.h"

namespace strata {

struct Frame;  // capture_format/frame.h
struct Sun;    // capture_format/frame/weather.h

/// In the order of the device's records: the sun as a directional light when it shines, then those of Frame::lights that do. A
/// light of no intensity or range is not on the list.
std::vector<Light> light_list(const Frame&);

/// The most iterations that the loops over these lights, their blockers and portals take in a shader that culls none of them.
std::uint64_t light_iterations(std::span<const Light>);

/// Whether a light has intensity and, unless it is directional, range.
bool shines(const Light&);
bool shines(const Sun&);

}  // namespace strata
