#include "tests/support/shell_lines.h"

#include <algorithm>

#include <fmt/core.h>

#include "captures/scenarios.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "replay/session/choice_text.h"
#include "replay/shell_word.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view program = STRATA_BINARY_DIR "/strata";

std::string key_and_value(const SettingChange& change) {
    ChoiceChanges alone;
    alone.settings.push_back(change);
    const std::string text = set_texts(alone).front();
    return change.technique ? text.substr(change.technique->name.size() + 1) : text;
}

/// Whether the request uses the technique for its stage; scenarios record no choices.
bool is_used(const Technique& technique, const ChoiceChanges& choices) {
    const Technique* chosen = choices.technique(technique.stage);
    return &technique == (chosen ? chosen : techniques_of(technique.stage).front());
}

}  // namespace

std::string line_that_records(std::string_view scenario, const FrameVariant& variant) {
    const Scenario& recorded = *must(find_scenario(scenario));
    return fmt::format("{} record {} --size {}x{} --samples {}", program, scenario, recorded.width / variant.extent_divisor,
                       recorded.height / variant.extent_divisor, std::max(1u, variant.samples));
}

std::string line_that_judges(const Technique& technique, const Request& request, std::string_view scenario) {
    std::string line = fmt::format("{} && {} report {}.strata --stage {} --repeats 1",
                                   line_that_records(scenario, request.variant), program, scenario, name(technique.stage));
    // The measured technique and its settings are a row of the report; --use and --set are for the other stages.
    std::string row(short_name(technique));
    for (const SettingChange& change : request.choices.settings)
        if (change.fits(technique)) row += fmt::format(" {}", key_and_value(change));
    line += fmt::format(" --techniques {}", as_shell_word(row));
    for (const Technique& other : techniques()) {
        if (other.stage == technique.stage || !is_used(other, request.choices)) continue;
        if (request.choices.technique(other.stage)) line += fmt::format(" --use {}", other.name);
        for (const SettingChange& change : request.choices.settings)
            if (change.fits(other))
                line += fmt::format(" --set {}", as_shell_word(fmt::format("{}:{}", other.name, key_and_value(change))));
    }
    for (const Feature feature : request.variant.force) line += fmt::format(" --force {}", name(feature));
    return line;
}

std::string line_that_replays(std::string_view scenario, const FrameVariant& variant) {
    return fmt::format("{} && {} replay {}.strata -o out", line_that_records(scenario, variant), program, scenario);
}

}  // namespace strata
