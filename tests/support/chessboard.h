// A card far away under a fine chessboard: what alpha tests make of a texture's coarsest mip (docs/algorithms/deferred.md 4.4).
#pragma once

namespace strata {

struct Frame;  // capture_format/frame.h

/// Gives the first mesh and material of a frame of cards a chessboard of 128 x 128 fields of alpha 1 and 0. Across 42 pixels or
/// less its last mip, one texel of alpha .5, is all that is seen.
void paint_chessboard(Frame&, float cutoff);

}  // namespace strata
