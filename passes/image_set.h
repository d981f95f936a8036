// Images of a frame by name.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "passes/reference/image.h"

namespace strata {

/// Images of a frame by the names of frame_images.h, read back or computed in double.
using ImageSet = std::map<std::string, ReferenceImage, std::less<>>;

}  // namespace strata
