// What a request changes about the recorded choices, as the options --use and --set say it: parsed from them and written back.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/session/choices.h"

namespace strata {

struct FrameVariant;  // replay/session/frame_variant.h
struct Technique;     // passes/technique.h

/// A technique's name without its stage.
std::string_view short_name(const Technique&);

/// uses: techniques, at most one of a stage, as technique_called() of passes/registry.h finds them; sets: "key=value" for every
/// chosen technique that has the key, or "stage/technique:key=value". Fails for a technique that does not exist. Whether the
/// frame has the keys and they take the values is known to choose().
Result<ChoiceChanges> parse_choices(std::span<const std::string> uses, std::span<const std::string> sets);

/// "key=value", of this technique.
Result<SettingChange> parse_setting(const Technique&, std::string_view text);

/// A technique with settings, of a list of techniques.
struct ParsedVariant {
    const Technique* technique = nullptr;
    std::vector<SettingChange> settings;
    std::string text;  ///< of the settings: "key=value ..."
};
/// "technique key=value ...", the technique as a user names it, of the given stage. Fails for values out of range, too.
Result<ParsedVariant> parse_variant(Stage, std::string_view text);

/// "stage/technique" of every technique, in the order of the stages.
std::vector<std::string> use_texts(const ChoiceChanges&);
/// "stage/technique:key=value", or "key=value" of a change for every chosen technique that has the key.
std::vector<std::string> set_texts(const ChoiceChanges&);
/// "strata replay CAPTURE --frames 0 --use ... --set ... --force ... --samples ... --eye ...": replays a frame by these choices.
std::string replay_command(std::string_view capture, const FrameVariant&, const ChoiceChanges&);

}  // namespace strata
