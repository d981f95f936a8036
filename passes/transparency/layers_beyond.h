// A view for techniques that keep a bounded number of layers: how many more a pixel has.
#pragma once

#include <cstdint>
#include <string>

#include "passes/graph/step.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

/// Visible fragments beyond the first `kept`, of the pixel's worst sample, in all channels of an rgba32f image with that name.
Image layers_beyond(Graph&, const FrameImages&, std::uint32_t kept, const std::string& name);

}  // namespace strata
