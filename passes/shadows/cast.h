// Draws the casters into shadow maps: what all techniques that look maps up begin with.
#pragma once

#include "passes/scene/shadow_views.h"
#include "passes/shadows/shadow_map_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

/// Makes FrameImages::shadow_maps and draws every map into its place; nothing where no light has a map.
void cast_maps(Graph&, FrameImages&, Allocation, CasterMask);

}  // namespace strata
