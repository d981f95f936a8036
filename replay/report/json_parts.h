// What several reports say alike in JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "replay/gpu/device.h"
#include "replay/measure/timing.h"

namespace strata {

nlohmann::ordered_json json_of(const Spread&);
nlohmann::ordered_json json_of(const DeviceInfo&);

}  // namespace strata
