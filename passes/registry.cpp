#include "passes/registry.h"

#include <algorithm>

#include "capture_format/nearest_name.h"
#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {
namespace {

bool is_called(const Technique& technique, std::string_view word) {
    return technique.name.substr(technique.name.find('/') + 1) == word || std::ranges::count(technique.aliases, word) > 0;
}

std::string names_of(std::span<const Technique* const> all) {
    std::string text;
    for (const Technique* technique : all) text += fmt::format("{}{}", text.empty() ? "" : " or ", technique->name);
    return text;
}

}  // namespace

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
    return fail(Fault::usage, "technique.unknown", "no technique {technique}{suggestion}", name, did_you_mean(name, known));
}

std::vector<std::string_view> words_for_techniques(std::optional<Stage> stage) {
    std::vector<std::string_view> known;
    for (const Technique& technique : techniques()) {
        if (stage && technique.stage != *stage) continue;
        known.insert(known.end(), {technique.name, technique.name.substr(technique.name.find('/') + 1)});
        known.insert(known.end(), technique.aliases.begin(), technique.aliases.end());
    }
    return known;
}

std::vector<const Technique*> techniques_called(std::string_view word) {
    const std::size_t slash = word.find('/');
    const std::optional<Stage> stage = find_stage(word.substr(0, slash));
    std::vector<const Technique*> found;
    for (const Technique& technique : techniques()) {
        const bool is_meant = slash == word.npos ? is_called(technique, word)
                                                 : technique.stage == stage && is_called(technique, word.substr(slash + 1));
        if (is_meant) found.push_back(&technique);
    }
    return found;
}

Result<const Technique*> technique_called(std::string_view word, std::optional<Stage> of) {
    std::vector<const Technique*> found = techniques_called(word);
    const auto is_elsewhere = [&](const Technique* one) { return of && one->stage != *of; };
    if (!std::ranges::all_of(found, is_elsewhere)) std::erase_if(found, is_elsewhere);
    if (found.size() == 1 && is_elsewhere(found.front()))
        return fail(Fault::usage, "technique.of_another_stage", "{technique} belongs to stage {stage}, not to {wanted}", word,
                    name(found.front()->stage), name(*of));
    if (found.size() == 1) return found.front();
    if (found.size() > 1)
        return fail(Fault::usage, "technique.ambiguous", "{stages} stages have a technique {technique}: choose {known}",
                    found.size(), word, names_of(found));
    const auto stage = find_stage(word);
    if (stage && !techniques_of(*stage).empty())
        return fail(Fault::usage, "technique.is_a_stage", "{word} is the stage {stage}, not a technique: choose {known}", word,
                    name(*stage), names_of(techniques_of(*stage)));
    return fail(Fault::usage, "technique.unknown", "no technique {technique}{suggestion}", word,
                did_you_mean(word, words_for_techniques(of)));
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
