// The frames that the program without_memory records: a little of everything, and enough that filters are tried.
#pragma once

#include <array>

#include "capture_format/frame/frame.h"

namespace strata {

std::array<Frame, 2> two_frames();

}  // namespace strata
