// The table of contents of a frame: stages in order, each with its chosen technique, or the reason it is left out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture_format/result.h"
#include "passes/capability.h"
#include "passes/frame_images.h"
#include "replay/session/choices.h"
#include "replay/session/skipped_stage.h"

namespace strata {

/// Why the device of the images cannot do their frame as chosen, or nothing.
std::optional<Error> beyond_device(const Choice&, const FrameImages&);

/// One thing a technique did: its own stage, or a pass at another one.
struct DeclaredPass {
    const Technique* technique = nullptr;
    Stage at;
    std::uint32_t scope = 0;  ///< in Graph::scopes
    FrameImages before;       ///< the handles as the pass found them
};

struct DeclaredFrame {
    std::vector<SkippedStage> skipped;
    std::vector<DeclaredPass> passes;
};

/// Called after each pass was declared; may replace its scope (the memo).
using AfterPass = std::function<void(const DeclaredPass&)>;

/// Declares the frame: fills `graph` and `images`. Stages whose `unwanted` gives a reason are left out and listed.
Result<DeclaredFrame> declare_frame(Graph&, FrameImages& images, const Choices&, const Capabilities& device,
                                    const AfterPass& = {});

}  // namespace strata
