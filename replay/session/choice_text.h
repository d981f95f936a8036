// What a request changes about the recorded choices, as the options --use and --set say it: parsed from them and written back.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/session/frame_plan.h"

namespace strata {

/// A technique's name without its stage.
std::string_view short_name(const Technique&);

/// uses: "stage/technique", at most one of a stage, or "technique" where one stage alone has it; sets: "key=value" for every
/// chosen technique that has the key, or "stage/technique:key=value". Fails for a technique that does not exist. Whether the
/// frame has the keys and they take the values is known to choose().
Result<ChoiceChanges> parse_choices(std::span<const std::string> uses, std::span<const std::string> sets);

/// "key=value", of this technique.
Result<SettingChange> parse_setting(const Technique&, std::string_view text);

/// A technique with settings, of a list of methods.
struct Method {
    const Technique* technique = nullptr;
    std::vector<SettingChange> settings;
    std::string text;  ///< of the settings: "key=value ..."
};
/// "technique key=value ...", with or without its stage, which must be the given one. Fails for values out of range, too.
Result<Method> parse_method(Stage, std::string_view text);

/// "stage/technique" of every technique, in the order of the stages.
std::vector<std::string> use_texts(const ChoiceChanges&);
/// "stage/technique:key=value", or "key=value" of a change for every chosen technique that has the key.
std::vector<std::string> set_texts(const ChoiceChanges&);

}  // namespace strata
