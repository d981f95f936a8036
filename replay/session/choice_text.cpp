#include "replay/session/choice_text.h"

#include <algorithm>

namespace strata {
namespace {

/// "key=value" or "stage/technique:key=value".
Result<SettingChange> parse_set(std::string_view set) {
    const std::size_t equals = set.find('=');
    if (equals == std::string_view::npos) return fail(Fault::usage, "--set takes key=value, not '{}'", set);
    const std::string_view value = set.substr(equals + 1), place = set.substr(0, equals);
    const std::size_t colon = place.find(':');
    SettingChange change{nullptr, std::string(place.substr(colon == place.npos ? 0 : colon + 1)), std::string(value)};
    if (colon == place.npos) return change;
    const auto technique = find_technique(place.substr(0, colon));
    if (!technique) return fail(Fault::usage, "no chosen technique has a parameter '{}'", change.key);
    change.technique = *technique;
    Settings settings((*technique)->params);
    // A value that the technique refuses stays text: choose() says what is wrong with it.
    if (settings.set(change.key, value)) change.value = settings.get(change.key);
    return change;
}

std::string text_of(const SettingChange& change) {
    if (const auto* text = std::get_if<std::string>(&change.value)) {
        return fmt::format("{}{}{}={}", change.technique ? change.technique->name : "", change.technique ? ":" : "", change.key,
                           *text);
    }
    const auto param = std::ranges::find(change.technique->params, change.key, &Param::name);
    return fmt::format("{}:{}={}", change.technique->name, change.key, text_of(*param, std::get<double>(change.value)));
}

}  // namespace

Result<ChoiceChanges> parse_choices(std::span<const std::string> uses, std::span<const std::string> sets) {
    ChoiceChanges changes;
    for (const std::string& use : uses) {
        const auto technique = find_technique(use);
        if (!technique) return technique.error();
        changes.use(**technique);
    }
    for (const std::string& set : sets) {
        auto change = parse_set(set);
        if (!change) return change.error();
        changes.settings.push_back(*std::move(change));
    }
    return changes;
}

Result<SettingChange> parse_setting(const Technique& technique, std::string_view text) {
    return parse_set(fmt::format("{}:{}", technique.name, text));
}

std::vector<std::string> use_texts(const ChoiceChanges& changes) {
    std::vector<std::string> texts;
    for (const Technique* technique : changes.techniques)
        if (technique) texts.emplace_back(technique->name);
    return texts;
}

std::vector<std::string> set_texts(const ChoiceChanges& changes) {
    std::vector<std::string> texts;
    for (const SettingChange& change : changes.settings) texts.push_back(text_of(change));
    return texts;
}

}  // namespace strata
