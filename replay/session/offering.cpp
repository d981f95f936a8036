#include "replay/session/offering.h"

#include <fmt/ranges.h>

#include "passes/registry.h"

namespace strata {

Result<const Technique*> technique_offering(const Offer& offer, const ChoiceChanges& choices) {
    std::vector<const Technique*> offering;
    std::vector<std::string_view> names;
    for (const Technique& technique : techniques())
        if (offer.is_made_by(technique)) {
            offering.push_back(&technique);
            names.push_back(technique.name);
        }
    if (offering.empty()) return fail(Fault::usage, "every technique that is built in {}", offer.lacking);
    const Technique* chosen = choices.technique(offering.front()->stage);
    if (!chosen) return offering.front();
    if (!offer.is_made_by(*chosen))
        return fail(
            Fault::usage, "{} {}; {}", chosen->name, offer.lacking,
            names.size() == 1 ? fmt::format("{} does", names.front()) : fmt::format("these do: {}", fmt::join(names, ", ")));
    return chosen;
}

}  // namespace strata
