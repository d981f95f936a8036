// `strata inspect`: a window over a capture, or a script that plays one.
#pragma once

#include <filesystem>
#include <string>

#include "replay/session/session.h"

namespace strata::ui {

struct InspectOptions {
    std::filesystem::path capture;
    DeviceChoice device;
    Partial partial = Partial::refused;
    Request first;                                            ///< what is shown at first
    std::filesystem::path shaders;                            ///< of a folder instead of those built in; empty: those
    std::filesystem::path script;                             ///< empty: a window
    std::pair<std::uint32_t, std::uint32_t> extent = {0, 0};  ///< of window or pictures; 0: as it was left, or 1280 x 800
};

Result<void> inspect(const InspectOptions&);

}  // namespace strata::ui
