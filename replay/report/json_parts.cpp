#include "replay/report/json_parts.h"

#include <nlohmann/json.hpp>

namespace strata {

nlohmann::ordered_json json_of(const Spread& spread) {
    return {
        {"median", spread.median}, {"mad", spread.mad}, {"low", spread.low}, {"high", spread.high}, {"repeats", spread.repeats}};
}

nlohmann::ordered_json json_of(const DeviceInfo& device) {
    return {{"name", device.name},
            {"driver", device.driver},
            {"driver_version", device.driver_version},
            {"cpu", device.cpu},
            {"software", device.software}};
}

}  // namespace strata
