// What the program without_memory records: of everything a little, and enough of it that filters are tried.
#pragma once

#include <array>

#include "capture_format/frame/frame.h"

namespace strata {

std::array<Frame, 2> two_frames();

}  // namespace strata
