// The table of contents of a frame: stages in order, each with its chosen technique, or the reason it is left out.
#pragma once

#include <map>
#include <set>
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
/// uses: "stage/technique"; sets: "key=value" for the one chosen technique that has the key, or "stage/technique:key=value".
Result<Choices> choose(const Frame&, std::span<const std::string> uses, std::span<const std::string> sets);

struct SkippedStage {
    Stage stage;
    std::string reason;
};

/// Declares the frame: fills `graph` and `images`. Stages whose `unwanted` gives a reason are left out and listed.
Result<std::vector<SkippedStage>> declare_frame(Graph&, FrameImages& images, const Choices&, const Capabilities&);

}  // namespace strata
