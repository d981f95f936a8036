// Which way a device rounds what it blends, measured: one pixel is blended and read back.
#pragma once

#include "passes/blend_rounding.h"
#include "replay/gpu/device.h"

namespace strata {

/// Takes 85 ms on lavapipe the first time in a process and 12 to 18 ms after that, most of them for one pipeline: ask for it
/// where a model is judged, not where a device is opened. Throws DeviceFailure.
BlendRounding measured_rounding(Device&);

}  // namespace strata
