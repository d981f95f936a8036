// Which draw of a frame is which of the frame before: the one whose to_world it says it had. So a frame that draws a few more, a
// few less, or in another order still continues the draws it shares with the last one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "capture_format/codec/frame_delta.h"

namespace strata {

/// The runs that make the second flatbuffer out of the first, for FrameChain::pack(). Both are as encode_frame() gave them.
std::vector<FrameChain::Run> draw_runs(std::span<const std::byte> before, std::span<const std::byte> now);

}  // namespace strata
