#include "replay/session/choice_text.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "capture_format/nearest_name.h"
#include "passes/registry.h"

namespace strata {
namespace {

/// A technique as a user names it: with its stage, or without where no other stage has one of that name.
Result<const Technique*> technique_of_word(std::string_view word) {
    if (word.find('/') != word.npos) return find_technique(word);
    std::vector<const Technique*> found;
    std::vector<std::string_view> names, known;
    for (const Technique& technique : techniques()) {
        known.insert(known.end(), {technique.name, short_name(technique)});
        if (short_name(technique) != word) continue;
        found.push_back(&technique);
        names.push_back(technique.name);
    }
    if (found.empty()) return fail_unnamed(Fault::usage, "no technique {}{}", word, did_you_mean(word, known));
    if (found.size() > 1)
        return fail_unnamed(Fault::usage, "{} stages have a technique {}: choose {}", found.size(), word,
                            fmt::join(names, " or "));
    return found.front();
}

/// "key=value" or "stage/technique:key=value".
Result<SettingChange> parse_set(std::string_view set) {
    const std::size_t equals = set.find('=');
    if (equals == std::string_view::npos) return fail_unnamed(Fault::usage, "--set takes key=value, not '{}'", set);
    const std::string_view value = set.substr(equals + 1), place = set.substr(0, equals);
    const std::size_t colon = place.find(':');
    SettingChange change{nullptr, std::string(place.substr(colon == place.npos ? 0 : colon + 1)), std::string(value)};
    if (colon == place.npos) return change;
    const auto technique = technique_of_word(place.substr(0, colon));
    if (!technique) return technique.error();
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

std::string_view short_name(const Technique& technique) { return technique.name.substr(technique.name.find('/') + 1); }

Result<ChoiceChanges> parse_choices(std::span<const std::string> uses, std::span<const std::string> sets) {
    ChoiceChanges changes;
    for (const std::string& use : uses) {
        const auto technique = technique_of_word(use);
        if (!technique) return technique.error();
        const Technique* earlier = changes.techniques[static_cast<std::size_t>((*technique)->stage)];
        if (earlier)
            return fail_unnamed(Fault::usage, "--use names two techniques of one stage: {} and {}", earlier->name,
                                (*technique)->name);
        changes.use(**technique);
    }
    for (const std::string& set : sets) {
        auto change = parse_set(set);
        if (!change) return change.error();
        const auto is_same = [&](const SettingChange& earlier) {
            return earlier.technique == change->technique && earlier.key == change->key;
        };
        if (const auto earlier = std::ranges::find_if(changes.settings, is_same); earlier != changes.settings.end())
            return fail_unnamed(Fault::usage, "--set gives {} twice: {} and {}", change->key, text_of(*earlier),
                                text_of(*change));
        changes.settings.push_back(*std::move(change));
    }
    return changes;
}

Result<SettingChange> parse_setting(const Technique& technique, std::string_view text) {
    return parse_set(fmt::format("{}:{}", technique.name, text));
}

Result<Method> parse_method(Stage stage, std::string_view text) {
    std::istringstream words{std::string(text)};
    std::string word;
    words >> word;
    const auto found = find_technique(word.find('/') == word.npos ? fmt::format("{}/{}", name(stage), word) : word);
    if (!found) return found.error();
    if ((*found)->stage != stage)
        return fail_unnamed(Fault::usage, "{} is of the stage {}, not of {}", word, name((*found)->stage), name(stage));
    Method method{*found, {}, ""};
    Settings settings((*found)->params);
    while (words >> word) {
        auto change = parse_setting(**found, word);
        if (!change) return change.error();
        if (const auto done = std::visit([&](const auto& value) { return settings.set(change->key, value); }, change->value);
            !done)
            return done.error();
        if (std::ranges::count(method.settings, change->key, &SettingChange::key) > 0)
            return fail_unnamed(Fault::usage, "--methods gives {} twice in '{}'", change->key, text);
        method.settings.push_back(*std::move(change));
        method.text += fmt::format("{}{}", method.text.empty() ? "" : " ", word);
    }
    return method;
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
