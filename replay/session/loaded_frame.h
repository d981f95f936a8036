// One recorded frame with what a request changes about it (extent, samples, the eye, forced features), ready for the device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/scene/scene_facts.h"
#include "replay/scene/scene_records.h"
#include "replay/session/frame_variant.h"

namespace strata {

/// Stays where it is: `facts` refer to `frame`.
struct LoadedFrame {
    LoadedFrame(FrameVariant, Frame recorded);
    ~LoadedFrame();

    FrameVariant variant;
    Frame frame;              ///< pre-exposed: Session gives radiance in the recorded unit
    SceneFacts facts{frame};  ///< made at first use, when textures are as the device can hold them
    Features features;
    std::vector<std::string> notes;
    std::uint64_t key = 0;  ///< differs between variants, for the memo
};

/// Applies the variant to a recorded frame. Fails when the extent would vanish.
Result<std::unique_ptr<LoadedFrame>> load_frame(Frame recorded, const FrameVariant&);

}  // namespace strata
