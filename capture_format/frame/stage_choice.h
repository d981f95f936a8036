// How the stages of a frame were done when it was recorded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture_format/safe_variant.h"

namespace strata {

using SettingValue = SafeVariant<std::int64_t, double, std::string>;
struct Setting {
    std::string key;
    SettingValue value;
};

/// How a stage was done when the frame was recorded. Names are strings: the format knows no technique.
struct StageChoice {
    std::string stage, technique;
    std::vector<Setting> settings;
};

}  // namespace strata
