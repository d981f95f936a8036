// Pictures against each other, pixel by pixel.
#pragma once

#include <functional>
#include <string>

#include "replay/images/host_image.h"
#include "tests/7_inspector_window/driven_window.h"

namespace strata {

struct Differing {
    std::size_t pixels = 0;
    std::string first;  ///< where, and what both have there
};

/// Pixels of `part` at the place against those of the whole; where a pixel of the whole is left out it says so.
using LeftOut = std::function<bool(int x, int y)>;
Differing differing(const HostImage& whole, int left, int top, const HostImage& part, const LeftOut& left_out);

}  // namespace strata
