// Draws the casters into shadow maps: what all techniques that look maps up begin with.
#pragma once

#include <vector>

#include "passes/scene/shadow_views.h"
#include "passes/shadows/shadow_map_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

/// The frame's views without those whose maps are unused and stay empty.
std::vector<ShadowView> drawn_views(const FrameImages&, Allocation);

/// Makes FrameImages::shadow_maps and draws every map that is used into its place; nothing where no light has a map.
void cast_maps(Graph&, FrameImages&, Allocation, CasterMask);

}  // namespace strata
