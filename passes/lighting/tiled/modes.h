// The shading modes of tiled lighting: sets of features, each a shader of its own (docs/algorithms/lighting.md 3.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/lighting/tiled/tiled_params.h"

namespace strata::lighting {

/// Features by the mode's number: the first `modes` settings mode_0, mode_1 ..., and after them one of all features where these
/// have none, so that every spectrum has a mode. At most most_modes.
std::vector<std::uint32_t> mode_features(const TiledParams&);

/// The modes that tiles of a frame may choose, from cheap to dear (of equal ones the smaller number first). The first of them
/// with all of a tile's features is the cheapest there is, so that the device needs no table of 65536 spectra, and the order of
/// the settings does not matter. A mode that is the choice for none of the spectra, which must hold the union of all of them, is
/// left out: it is neither compiled nor dispatched. The last mode serves every spectrum. With branches=uniform there is one mode.
ModeOrder mode_order(const TiledParams&, std::span<const std::uint32_t> spectra);

}  // namespace strata::lighting
