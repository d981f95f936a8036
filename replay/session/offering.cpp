#include "replay/session/offering.h"

#include <fmt/ranges.h>

#include "passes/registry.h"

namespace strata {

Result<const Technique*> technique_offering(const Offer& offer, std::span<const std::string> uses) {
    std::vector<const Technique*> offering;
    std::vector<std::string_view> names;
    for (const Technique& technique : techniques())
        if (offer.is_made_by(technique)) {
            offering.push_back(&technique);
            names.push_back(technique.name);
        }
    if (offering.empty()) return fail(Fault::usage, "every technique that is built in {}", offer.lacking);
    const Technique* chosen = offering.front();
    for (const std::string& use : uses) {
        const auto technique = find_technique(use);
        if (!technique) return technique.error();
        if ((*technique)->stage != offering.front()->stage) continue;
        if (!offer.is_made_by(**technique))
            return fail(
                Fault::usage, "{} {}; {}", use, offer.lacking,
                names.size() == 1 ? fmt::format("{} does", names.front()) : fmt::format("these do: {}", fmt::join(names, ", ")));
        chosen = *technique;
    }
    return chosen;
}

}  // namespace strata
