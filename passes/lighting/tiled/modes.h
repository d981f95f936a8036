// The shading modes of tiled lighting: sets of features, each a shader of its own (lighting chapter 3.3).
#pragma once

#include <cstdint>
#include <vector>

#include "passes/lighting/tiled/tiled.shared.h"

namespace strata::lighting {

/// Features by the mode's number: the first `modes` settings mode_0, mode_1 ..., and after them one of all features where these
/// have none, so that every spectrum has a mode. At most most_modes.
std::vector<std::uint32_t> mode_features(const TiledParams&);

/// The modes that tiles of a frame may choose, from cheap to dear (of equal ones the smaller number first), then one of all
/// features. The first of them with all of a tile's features is the cheapest there is, so that the device needs no table of 65536
/// spectra, and the order of the settings does not matter. A mode that is the choice for no subset of the frame's features is
/// left out: it is neither compiled nor dispatched. With branches=uniform there is one mode.
ModeOrder mode_order(const TiledParams&, std::uint32_t frame_features);

}  // namespace strata::lighting
