// Which way a device rounds what it blends, measured: one pixel is blended and read back.
#pragma once

#include "passes/blend_rounding.h"
#include "replay/gpu/device.h"

namespace strata {

/// Takes about 15 ms on lavapipe, most of them for one pipeline: ask for it where a model is judged, not where a device is
/// opened. Throws DeviceFailure.
BlendRounding measured_rounding(Device&);

}  // namespace strata
