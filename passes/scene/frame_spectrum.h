// The feature spectrum of a whole frame as the host knows it before anything is drawn (docs/algorithms/lighting.md 3.6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/frame/light.h"
#include "passes/scene/draw_bounds.h"

namespace strata {

/// Bits of light_features.shared.h that shading any tile of the frame may need: of every light whose range meets the view, and of
/// every opaque surface in it. A superset of what the tiles' own spectra hold together, so that what it lacks need not be
/// compiled, allocated or dispatched: tiles know what is hidden, and which blockers reach them.
std::uint32_t frame_spectrum(const Frame&, std::span<const Light>, const DrawBounds&);

/// Every spectrum that a tile of the frame may have, of the given features alone: the unions of what the frame's lights and
/// surfaces need. A light brings its type, picture and sign to every tile that it is listed in; its blockers, portals, clip
/// planes and shadows only to some. The empty spectrum is first, and the union of any two spectra is among them.
std::vector<std::uint32_t> possible_spectra(const Frame&, std::span<const Light>, const DrawBounds&, std::uint32_t features);

}  // namespace strata
