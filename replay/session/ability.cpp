#include "replay/session/ability.h"

#include <fmt/ranges.h>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/session/choices.h"

namespace strata {

Result<const Technique*> technique_with(const Ability& ability, const ChoiceChanges& choices) {
    std::vector<const Technique*> able;
    std::vector<std::string_view> names;
    for (const Technique& technique : techniques())
        if (ability.is_had_by(technique)) {
            able.push_back(&technique);
            names.push_back(technique.name);
        }
    if (able.empty())
        return fail(Fault::usage, "technique.none_is_able", "no technique can do this: each {lacking}", ability.lacking);
    const Technique* chosen = choices.technique(able.front()->stage);
    if (!chosen) return able.front();
    if (!ability.is_had_by(*chosen))
        return fail(
            Fault::usage, "technique.is_unable", "{technique} {lacking}; {able}", chosen->name, ability.lacking,
            names.size() == 1 ? fmt::format("{} does", names.front()) : fmt::format("these do: {}", fmt::join(names, ", ")));
    return chosen;
}

}  // namespace strata
