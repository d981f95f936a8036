// One recorded frame with what a request changes about it (extent, samples, the eye, forced features), ready for the device.
#pragma once

#include <memory>
#include <utility>

#include "capture_format/frame_features.h"
#include "passes/scene/scene_facts.h"
#include "replay/scene/scene_records.h"
#include "replay/session/session.h"

namespace strata {

/// What tells two loaded frames apart.
struct FrameVariant {
    std::size_t frame = 0;
    std::uint32_t extent_divisor = 1, samples = 0;
    EyeMove eye;
    std::vector<Feature> force;
    friend bool operator==(const FrameVariant&, const FrameVariant&) = default;
};

/// Stays where it is: `facts` refer to `frame`.
struct LoadedFrame {
    LoadedFrame(FrameVariant of, Frame recorded) : variant(std::move(of)), frame(std::move(recorded)) {}

    FrameVariant variant;
    Frame frame;
    SceneFacts facts{frame};  ///< made at first use, when textures are as the device can hold them
    Features features;
    std::vector<std::string> notes;
    std::uint64_t key = 0;  ///< differs between variants, for the memo
};

FrameVariant variant_of(const Request&);
/// Applies the variant to a recorded frame. Fails when the extent would vanish.
Result<std::unique_ptr<LoadedFrame>> load_frame(Frame recorded, const FrameVariant&);

}  // namespace strata
