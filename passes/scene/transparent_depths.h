// The view depths of a frame's transparent geometry, which techniques that cut depth into parts or warp it map it by.
#pragma once

#include "passes/depth_range.h"
#include "passes/scene/draw_lists.h"

namespace strata {

/// Nearest and farthest view depth of transparent geometry in front of the near plane, depth offsets applied, without what is in
/// interface layers. Of a frame without any: the near plane and twice that. Walks every vertex and particle.
DepthRange world_depths(const Frame&, const DrawLists&);
/// The same range from the nearest interface layer on: the depths that fragments are ordered by.
DepthRange depths_with_layers(const Frame&, const DrawLists&, DepthRange world);

/// By how much a particle is at most sorted nearer than it is tested, in meters.
float farthest_depth_offset(const Frame&);

}  // namespace strata
