// Which technique does which stage of a frame, with which settings.
#pragma once

#include <array>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "capture_format/safe_variant.h"
#include "passes/settings.h"
#include "passes/stage.h"

namespace strata {

struct Frame;      // capture_format/frame.h
struct Technique;  // passes/technique.h

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
    SafeVariant<double, std::string> value;
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
    void use(const Technique&);
    const Technique* technique(Stage stage) const { return techniques[static_cast<std::size_t>(stage)]; }
    /// Takes out everything that names a technique of the stage.
    void drop(Stage);
    friend bool operator==(const ChoiceChanges&, const ChoiceChanges&) = default;
};

/// Each stage's default; then the capture's own choices, but for stages that the changes give another technique; then the
/// changes. Fails (bad input) for a recorded choice that is not understood, and (usage) for a setting that no chosen technique
/// has and for a value that one of them refuses.
Result<Choices> choose(const Frame&, const ChoiceChanges& = {});

}  // namespace strata
