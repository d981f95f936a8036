// Finds techniques by name and by stage. The table itself is written by the build from the list in passes/CMakeLists.txt.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "passes/technique.h"

namespace strata {

/// What the function of every technique on the list returns; written by the build.
std::vector<Technique> technique_table();

/// Every technique on the list, in the list's order.
std::span<const Technique> techniques();

/// Fails with the nearest known name: "no technique transparency/weigthed; did you mean transparency/weighted?"
Result<const Technique*> find_technique(std::string_view name);
/// The techniques of a stage, in the list's order; the first is the stage's default.
std::vector<const Technique*> techniques_of(Stage);
/// The first of its features that the technique cannot do, or nothing.
std::optional<Feature> unsupported(const Technique&, const Features&);
/// The same with why the frame has it: "chromatic (material 'ruby' lets ...)"; empty where the technique can do the frame.
std::string unsupported_because(const Technique&, const Features&);
/// The technique's place among those of its stage: what generated shader switches (gbuffer decoders) use.
std::uint32_t index_in_stage(const Technique&);

}  // namespace strata
