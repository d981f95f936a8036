// Where transparent events are in the order of blending: at their depth, or before all of the world with an interface layer.
#pragma once

#include <cstdint>

#include "capture_format/frame.h"

namespace strata {

/// Of a draw, or of emitter draw - draws.size(); 0 is the world.
std::uint32_t layer_of(const Frame&, std::uint32_t draw);
/// Of everything transparent; 0 where there is no interface.
std::uint32_t highest_layer(const Frame&);

/// In metres, of an event of a layer at view depth z, depth offset applied. Of a frame with interface layers: nothing of the
/// world is nearer than the near plane there, whatever its depth offset, so that all layers are in front of it.
double ordering_depth(const Frame&, std::uint32_t layer, double z);

}  // namespace strata
