// The table of contents of a frame: stages in order, each with its chosen technique, or the reason it is left out.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "capture_format/frame.h"
#include "capture_format/frame_features.h"
#include "passes/registry.h"

namespace strata {

/// A technique with its settings.
struct Choice {
    const Technique* technique = nullptr;
    Settings settings;
};
using Choices = std::map<Stage, Choice>;

/// What `--use` and `--set` mean: the capture's own choices where they name known techniques, else each stage's default.
/// uses: "stage/technique"; sets: "key=value" for the chosen techniques that have the key, or "stage/technique:key=value".
Result<Choices> choose(const Frame&, std::span<const std::string> uses, std::span<const std::string> sets);

struct SkippedStage {
    Stage stage;
    std::string reason;
};

/// One thing a technique did: its own stage, or an act at another one.
struct DeclaredAct {
    const Technique* technique = nullptr;
    Stage at;
    std::uint32_t scope = 0;  ///< in Graph::scopes
    FrameImages before;       ///< the handles as the act found them
};

struct DeclaredFrame {
    std::vector<SkippedStage> skipped;
    std::vector<DeclaredAct> acts;
};

/// Called after each act was declared; may replace its scope (the memo).
using AfterAct = std::function<void(const DeclaredAct&)>;

/// Declares the frame: fills `graph` and `images`. Stages whose `unwanted` gives a reason are left out and listed.
Result<DeclaredFrame> declare_frame(Graph&, FrameImages& images, const Choices&, const Capabilities& device,
                                    const AfterAct& = {});

}  // namespace strata
