// The table of contents of a frame: stages in order, each with its chosen technique, or the reason it is left out.
#pragma once

#include <array>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <variant>
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

/// A parameter with another value than the recorded one or the default.
struct SettingChange {
    const Technique* technique = nullptr;  ///< null: every chosen technique that has the key
    std::string key;
    /// A number. A text where no one technique reads it, or where the technique refuses it.
    std::variant<double, std::string> value;
    friend bool operator==(const SettingChange&, const SettingChange&) = default;
    /// Whether it is a setting of this technique, chosen or not.
    bool fits(const Technique&) const;
};
bool has_param(const Technique&, std::string_view key);

/// What a request changes about the choices that a frame was recorded with.
struct ChoiceChanges {
    /// By stage, each with its default settings; null: the recorded one with its settings.
    std::array<const Technique*, std::size(stage_names)> techniques = {};
    std::vector<SettingChange> settings = {};  ///< later ones win
    void use(const Technique& technique) { techniques[static_cast<std::size_t>(technique.stage)] = &technique; }
    const Technique* technique(Stage stage) const { return techniques[static_cast<std::size_t>(stage)]; }
    /// Takes out everything that names a technique of the stage.
    void drop(Stage);
    friend bool operator==(const ChoiceChanges&, const ChoiceChanges&) = default;
};

/// The capture's own choices where they name known techniques, else each stage's default; then the changes. Fails for a setting
/// that no chosen technique has, and for a value that one of them refuses.
Result<Choices> choose(const Frame&, const ChoiceChanges& = {});

/// Why the device of the images cannot do their frame as chosen, or nothing.
std::optional<std::string> beyond_device(const Choice&, const FrameImages&);

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
