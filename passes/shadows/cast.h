// Draws the casters into shadow maps: what all techniques that look maps up begin with.
#pragma once

#include "passes/frame_images.h"
#include "passes/scene/shadow_views.h"
#include "passes/shadows/shadow_map_params.h"

namespace strata {

/// Makes FrameImages::shadow_maps and draws every map into its place; nothing where no light has a map.
void cast_maps(Graph&, FrameImages&, Allocation, CasterMask);

}  // namespace strata
