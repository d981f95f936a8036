// The feature spectrum of a whole frame as the host knows it before anything is drawn (lighting chapter 3.6).
#pragma once

#include <cstdint>

#include "capture_format/frame.h"

namespace strata::lighting {

/// Bits of light_features.shared.h that shading any tile of the frame may need: of every light whose range meets the view, and of
/// every opaque surface in it. A superset of what the tiles' own spectra hold together, so that what it lacks need not be
/// compiled, allocated or dispatched: tiles know what is hidden, and which blockers reach them.
std::uint32_t frame_spectrum(const Frame&);

}  // namespace strata::lighting
