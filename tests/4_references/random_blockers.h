// Frames of random blockers and portals, the easy ones and the ones on the edge of a rule: rectangles without area, more blockers
// than a light may have, lights in a blocker's plane, portals that abut, lean, or lie beside their blocker.
#pragma once

#include "tests/4_references/tiny_frame.h"

namespace strata::tiny {

/// 48 blockers and about as many portals around an eye that looks anywhere, mirrored in half of the frames; an omni light, a
/// sphere light and a directional one that list them in any order, some of them twice. There are no draws.
Frame blockers_at_random(Random&);

}  // namespace strata::tiny
