#include "passes/registry.h"

#include <algorithm>

#include "capture_format/nearest_name.h"

namespace strata {

std::span<const Technique> techniques() {
    static const std::vector<Technique> kept = technique_table();
    return kept;
}

Result<const Technique*> find_technique(std::string_view name) {
    std::vector<std::string_view> known;
    for (const Technique& technique : techniques()) {
        if (technique.name == name) return &technique;
        known.push_back(technique.name);
    }
    return fail_unnamed(Fault::usage, "no technique {}{}", name, did_you_mean(name, known));
}

std::vector<const Technique*> techniques_of(Stage stage) {
    std::vector<const Technique*> found;
    for (const Technique& technique : techniques())
        if (technique.stage == stage) found.push_back(&technique);
    return found;
}

std::optional<Feature> unsupported(const Technique& technique, const Features& features) {
    const auto found = std::ranges::find_if(technique.cannot, [&](Feature feature) { return features.has(feature); });
    return found == technique.cannot.end() ? std::nullopt : std::optional(*found);
}

std::string unsupported_because(const Technique& technique, const Features& features) {
    const auto feature = unsupported(technique, features);
    return feature ? fmt::format("{} ({})", name(*feature), features.reason(*feature)) : "";
}

std::uint32_t index_in_stage(const Technique& technique) {
    std::uint32_t index = 0;
    for (const Technique* other : techniques_of(technique.stage)) {
        if (other->name == technique.name) return index;
        ++index;
    }
    assert(false && "index_in_stage: the technique is not on the list");
    return index;
}

}  // namespace strata
