// The stages of a frame in order, and per stage: when it is not needed, what it owns, its truth and its judge.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/frame_features.h"
#include "passes/blend_rounding.h"
#include "passes/reference/image.h"
#include "passes/stage.h"

namespace strata {

/// Images of a frame by the names of frame_images.h, read back or computed in double.
using ImageSet = std::map<std::string, ReferenceImage, std::less<>>;

class FragmentLists;
struct FrameImages;

/// What a model or a truth starts from: the recorded frame and the images as they were before the stage ran.
struct StageInput {
    const Frame& frame;
    const ImageSet& before;
    /// Where the frame's transparent fragments before the stage are kept from one model to the next, made when the first wants
    /// them; null: nowhere.
    std::optional<FragmentLists>* fragments = nullptr;
    BlendRounding rounding = {};  ///< of the device that a model is compared with; truths do not read it
};

/// One named number with its unit; smaller is better. The first figure of a judge is the stage's error.
struct Figure {
    std::string name, unit;
    double value = 0;
    bool is_detail = false;  ///< left out of tables for people
};

using Truth = ImageSet (*)(const StageInput&);
using Judge = std::vector<Figure> (*)(const ImageSet& result, const ImageSet& truth, const StageInput&);

/// What techniques approximate: the stage's truth, or at some of their settings another one.
struct TruthRow {
    std::string_view name = {};  ///< empty: the stage's truth
    Truth make = nullptr;
    std::string_view is = "exact, in double";  ///< how far a person may trust it
};

struct StageInfo {
    Stage stage = {};  ///< set by stages(), as is its name
    std::string_view name = {};
    std::string_view purpose;  ///< what it does, for people: "shades opaque surfaces with all lights"
    /// Why a frame with these features does not need the stage, or nothing.
    std::optional<std::string> (*unwanted)(const Features&);
    /// Why the device of these images cannot do the stage for their frame, whatever the technique, or nothing. Null: it always
    /// can.
    std::optional<std::string> (*beyond_device)(const FrameImages&) = nullptr;
    /// Images of frame_images.h the stage writes; the first is the one that is judged and shown.
    std::vector<std::string_view> outputs;
    Truth truth = nullptr;                           ///< null: the stage has no technique yet
    std::string_view truth_is = "exact, in double";  ///< how far a person may trust it
    std::vector<TruthRow> other_truths = {};         ///< of settings that approximate more or less (Technique::approximates)
    Judge judge = nullptr;
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
std::optional<Stage> find_stage(std::string_view name);

}  // namespace strata
