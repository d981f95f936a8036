#include "replay/session/choice_text.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "passes/graph/step.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/eye_move.h"
#include "replay/session/frame_variant.h"
#include "replay/shell_word.h"

namespace strata {
namespace {

/// "key=value" or "stage/technique:key=value".
Result<SettingChange> parse_set(std::string_view set) {
    const std::size_t equals = set.find('=');
    if (equals == std::string_view::npos)
        return fail(Fault::usage, "settings.no_value", "--set takes key=value, not '{given}'", set);
    const std::string_view value = set.substr(equals + 1), place = set.substr(0, equals);
    const std::size_t colon = place.find(':');
    SettingChange change{nullptr, std::string(place.substr(colon == place.npos ? 0 : colon + 1)), std::string(value)};
    if (colon == place.npos) return change;
    const auto technique = technique_called(place.substr(0, colon));
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
        const auto technique = technique_called(use);
        if (!technique) return technique.error();
        const Technique* earlier = changes.techniques[static_cast<std::size_t>((*technique)->stage)];
        if (earlier)
            return fail(Fault::usage, "technique.two_of_a_stage",
                        "{technique} and {other} are of one stage, which takes one technique", earlier->name, (*technique)->name);
        changes.use(**technique);
    }
    for (const std::string& set : sets) {
        auto change = parse_set(set);
        if (!change) return change.error();
        const auto is_same = [&](const SettingChange& earlier) {
            return earlier.technique == change->technique && earlier.key == change->key;
        };
        if (const auto earlier = std::ranges::find_if(changes.settings, is_same); earlier != changes.settings.end())
            return fail(Fault::usage, "settings.given_twice", "--set gives {setting} twice: {first} and {second}", change->key,
                        text_of(*earlier), text_of(*change));
        changes.settings.push_back(*std::move(change));
    }
    return changes;
}

Result<SettingChange> parse_setting(const Technique& technique, std::string_view text) {
    return parse_set(fmt::format("{}:{}", technique.name, text));
}

Result<ParsedVariant> parse_variant(Stage stage, std::string_view text) {
    std::istringstream words{std::string(text)};
    std::string word;
    words >> word;
    const auto found = technique_called(word, stage);
    if (!found) return found.error();
    ParsedVariant variant{*found, {}, ""};
    Settings settings((*found)->params);
    while (words >> word) {
        auto change = parse_setting(**found, word);
        if (!change) return change.error();
        if (const auto done = std::visit([&](const auto& value) { return settings.set(change->key, value); }, change->value);
            !done)
            return done.error();
        if (std::ranges::count(variant.settings, change->key, &SettingChange::key) > 0)
            return fail(Fault::usage, "settings.given_twice", "--techniques gives {setting} twice in '{variant}'", change->key,
                        text);
        variant.settings.push_back(*std::move(change));
        variant.text += fmt::format("{}{}", variant.text.empty() ? "" : " ", word);
    }
    return variant;
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

std::string replay_command(std::string_view capture, const FrameVariant& variant, const ChoiceChanges& choices) {
    std::string line = fmt::format("strata replay {} --frames {}", as_shell_word(capture), variant.frame);
    for (const std::string& use : use_texts(choices)) line += fmt::format(" --use {}", as_shell_word(use));
    for (const std::string& set : set_texts(choices)) line += fmt::format(" --set {}", as_shell_word(set));
    for (const Feature feature : variant.force) line += fmt::format(" --force {}", name(feature));
    if (variant.samples != 0) line += fmt::format(" --samples {}", variant.samples);
    if (const std::string eye = text(variant.eye); !eye.empty()) line += fmt::format(" --eye {}", as_shell_word(eye));
    return line;
}

}  // namespace strata
