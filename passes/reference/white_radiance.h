// About how bright a white surface is in a frame, derived apart from what feeds the device (passes/scene/pre_exposure.h).
#pragma once

namespace strata {

struct Frame;  // capture_format/frame.h

/// Radiance in the frame's unit, the largest of: a white surface in the sun, sky, ground, fog, and a white surface that faces a
/// light at a quarter of its range or at the scene's distance from it, the nearer (docs/algorithms/transparency.md 0.5). 0
/// without light.
double white_radiance(const Frame&);

}  // namespace strata
