// Looks for NaN and infinity in images.
#pragma once

#include <optional>
#include <string>

#include "replay/images/host_image.h"

namespace strata {

/// "(3, 4) layer 0: nan 1 1" of the first texel with a channel that is not finite, or nothing.
std::optional<std::string> texel_that_is_no_number(const HostImage&);

}  // namespace strata
