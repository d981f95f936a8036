// Textures that are too much for one buffer of the device lose their finest mips, in the frame itself: what renders it and what
// it is judged by then see the same textures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace strata {

struct Frame;  // capture_format/frame.h

/// Leaves out the finest mips of the largest textures until all take at most `budget` bytes, or only coarsest mips are left.
/// Returns a sentence for each texture that lost some.
std::vector<std::string> shrink_textures(Frame&, std::uint64_t budget);

}  // namespace strata
