// The stages of a frame in order, and per stage: when it is not needed, what it owns, its truth and its judge.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/metric.h"
#include "passes/stage.h"

namespace strata {

class Features;      // capture_format/frame_features.h
struct Error;        // capture_format/result.h
struct FrameImages;  // passes/frame_images.h

struct StageInfo {
    Stage stage = {};  ///< set by stages(), as is its name
    std::string_view name = {};
    std::string_view purpose;                    ///< what it does, for people: "shades opaque surfaces with all lights"
    std::vector<std::string_view> aliases = {};  ///< what the field calls it: "oit"; a user may write it in place of the name
    /// Why a frame with these features does not need the stage, or nothing.
    std::optional<std::string> (*unwanted)(const Features&);
    /// Why the device of these images cannot do the stage for their frame, whatever the technique, or nothing. Null: it always
    /// can.
    std::optional<Error> (*beyond_device)(const FrameImages&) = nullptr;
    /// Images of frame_images.h the stage writes; the first is the one that is judged and shown.
    std::vector<std::string_view> outputs;
    Truth truth = nullptr;                           ///< null: the stage has no technique yet
    std::string_view truth_is = "exact, in double";  ///< how far a person may trust it
    std::vector<TruthRow> other_truths = {};         ///< of settings that approximate more or less (Technique::approximates)
    Judge judge = nullptr;
    Settle settle = nullptr;  ///< null: no truth of the stage has alternatives
    /// Scenarios (captures/scenarios.h) that isolate what the stage can get wrong, the plainest first.
    std::vector<std::string_view> scenarios;
    /// Outputs of which its truth says nothing: the technique's own stay where the truth stands for the others.
    std::vector<std::string_view> leaves = {};
};

/// What the stage.cpp of every folder on the list says; written by the build.
std::vector<StageInfo> stage_table();

/// Every stage, in the order of a frame.
std::span<const StageInfo> stages();
const StageInfo& info(Stage);
inline std::string_view name(Stage stage) { return info(stage).name; }
/// By its name or an alias.
std::optional<Stage> find_stage(std::string_view name);
/// The same; fails with the nearest known name.
Result<Stage> stage_called(std::string_view name);

}  // namespace strata
