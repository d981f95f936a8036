// Finds techniques by name and by stage. The table itself is written by the build from the list in passes/CMakeLists.txt.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/stage.h"

namespace strata {

class Features;                      // capture_format/frame_features.h
enum class Feature : std::uint32_t;  // capture_format/frame_features.h
struct Technique;                    // passes/technique.h

/// What the function of every technique on the list returns; written by the build.
std::vector<Technique> technique_table();

/// Every technique on the list, in the list's order.
std::span<const Technique> techniques();

/// By its name. Fails with the nearest known name: "no technique transparency/weigthed; did you mean transparency/weighted?"
Result<const Technique*> find_technique(std::string_view name);
/// What a user may write for a technique of the stage, or of any: its name with or without the stage, or an alias.
std::vector<std::string_view> words_for_techniques(std::optional<Stage> = std::nullopt);
/// Those that a user may mean: by name, by name without the stage, or by an alias; the stage may be given by its alias, too.
std::vector<const Technique*> techniques_called(std::string_view word);
/// The one of those, of that stage where one is given. Fails where there is none or there are several, with the names to choose
/// from, and where the one is of another stage.
Result<const Technique*> technique_called(std::string_view word, std::optional<Stage> = std::nullopt);
/// The techniques of a stage, in the list's order; the first is the stage's default.
std::vector<const Technique*> techniques_of(Stage);
/// The first of its features that the technique cannot do, or nothing.
std::optional<Feature> unsupported(const Technique&, const Features&);
/// The same with why the frame has it: "chromatic (material 'ruby' lets ...)"; empty where the technique can do the frame.
std::string unsupported_because(const Technique&, const Features&);
/// The technique's place among those of its stage: what generated shader switches (gbuffer decoders) use.
std::uint32_t index_in_stage(const Technique&);

}  // namespace strata
