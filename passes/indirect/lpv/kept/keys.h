// What determines the light of a grid, as hashes of the recorded frame: equal keys give equal light, wherever the eye is.
#pragma once

#include <cstdint>
#include <vector>

#include "passes/indirect/lpv/device_grid.h"
#include "passes/indirect/lpv/lpv_params.h"

namespace strata::indirect {

struct GridKeys {
    uvec2 light{0};   ///< everything
    uvec2 place{0};   ///< the grid and the rules of its light, whatever is lit
    uvec2 linked{0};  ///< what its links are found with; 0 where it has none
    /// The cells that links lie between. Those of a cascade stay in the world when the cascade moves. They are others for every
    /// place of the eye that they are found by (LightEye).
    uvec2 lattice{0};
};
GridKeys keys_of(const FrameImages&, const LpvParams&, const DeviceGrid&);

/// A grid's first cell in its lattice.
glm::i64vec3 first_cell(const LightGrid&);

/// Of the frame's blockers, then of its portals as the device has them.
std::vector<uvec2> barrier_identities(const Frame&);

}  // namespace strata::indirect
