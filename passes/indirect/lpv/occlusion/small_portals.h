// Portals that are too small for the cells of a grid.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "passes/scene/light_grids.h"

namespace strata {

struct Portal;  // capture_format/frame/light.h

}  // namespace strata

namespace strata::indirect {

/// The largest share of a face between two cells that a portal opens, seen along an axis: the transmission that a link through it
/// has at least (docs/algorithms/lighting.md 5.6, T_min), whatever 8 x 8 ways meet. Exact for a portal that lies between two
/// cells' middles.
double opened_share(const LightGrid&, const Portal&);

/// A sentence for each axial grid in which portals are narrower than 1/8 of a cell: they fit between two of the 8 x 8 ways
/// through a face, so that no light may pass (docs/algorithms/lighting.md 5.6). Portals without area are closed and not counted.
/// Occlusion is one of occlusion_* (lpv.shared.h).
std::vector<std::string> notes_on_small_portals(const Frame&, std::span<const LightGrid>, std::uint32_t occlusion);

}  // namespace strata::indirect
