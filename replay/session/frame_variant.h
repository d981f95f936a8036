// Which recorded frame, and what a request changes about it before any technique sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "capture_format/frame_features.h"
#include "replay/session/eye_move.h"

namespace strata {

struct FrameVariant {
    std::size_t frame = 0;             ///< index in the capture
    std::uint32_t extent_divisor = 1;  ///< replays at extent / divisor, for quick truths
    std::uint32_t samples = 0;         ///< overrides the recorded samples when not 0
    EyeMove eye = {};                  ///< against the recorded one
    std::vector<Feature> force;        ///< features switched on though the frame lacks them; unused products are then made, too
    friend bool operator==(const FrameVariant&, const FrameVariant&) = default;
};

}  // namespace strata
