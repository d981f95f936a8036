// How many pipelines a device keeps. A program that opens many sessions on one device keeps more than a session uses.
#pragma once

#include <cstddef>

#include "replay/gpu/device.h"

namespace strata {

/// Enough for all techniques of a stage on frames of many kinds, which a session's usual number would make anew for each: 350 MB
/// on a CPU driver, and 1 GB with all their settings.
inline constexpr std::size_t many_pipelines = 256;

void keep_pipelines(Device&, std::size_t at_most);

}  // namespace strata
