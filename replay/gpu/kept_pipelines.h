// How many pipelines a device keeps. A program that opens many sessions on one device keeps more than a session uses.
#pragma once

#include <cstddef>

#include "replay/gpu/device.h"

namespace strata {

void keep_pipelines(Device&, std::size_t at_most);

}  // namespace strata
