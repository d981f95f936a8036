// Finds the technique a verb needs, for verbs that only some techniques support.
#pragma once

#include <string_view>

#include "capture_format/result.h"

namespace strata {

struct ChoiceChanges;  // replay/session/choices.h
struct Technique;      // passes/technique.h

/// What a verb needs of a technique (see Abilities), and how to say that one lacks it.
struct Ability {
    bool (*is_had_by)(const Technique&);
    std::string_view lacking;  ///< "makes no feature spectra"
};

/// The technique with the ability: the one chosen for the stage, which must have it, else the first on the list that has. Fails
/// (usage) with the names of those that do.
Result<const Technique*> technique_with(const Ability&, const ChoiceChanges&);

}  // namespace strata
