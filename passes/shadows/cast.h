// Draws the casters into shadow maps: what all techniques that look maps up begin with.
#pragma once

#include <vector>

#include "passes/scene/read_part.h"
#include "passes/scene/shadow_views.h"
#include "passes/shadows/shadow_map_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

/// A map that is drawn, and the part of it that is.
struct DrawnMap {
    std::uint32_t slot = 0;
    ShadowView view;
    MapPart part;
};
/// The frame's maps without those that nobody in view reads, which stay empty.
std::vector<DrawnMap> drawn_maps(const FrameImages&, Allocation);

/// Makes FrameImages::shadow_maps and draws of every map that is used the part that is looked up, of the casters that it sees;
/// nothing where no light has a map.
void cast_maps(Graph&, FrameImages&, Allocation, CasterMask);

}  // namespace strata
