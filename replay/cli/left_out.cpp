#include "replay/cli/left_out.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"
#include "replay/standard_streams.h"

namespace strata {
namespace {

/// Whether a setting reaches techniques of this stage alone.
bool is_of(const SettingChange& change, Stage stage) {
    bool found = false;
    for (const Technique& technique : techniques()) {
        if (!change.fits(technique)) continue;
        if (technique.stage != stage) return false;
        found = true;
    }
    return found;
}

/// What was chosen of a stage, as --use and --set say it.
std::vector<std::string> chosen_of(const ChoiceChanges& changes, Stage stage) {
    ChoiceChanges own;
    own.techniques[static_cast<std::size_t>(stage)] = changes.techniques[static_cast<std::size_t>(stage)];
    std::ranges::copy_if(changes.settings, std::back_inserter(own.settings),
                         [&](const SettingChange& change) { return is_of(change, stage); });
    std::vector<std::string> words = use_texts(own);
    std::ranges::move(set_texts(own), std::back_inserter(words));
    return words;
}

/// The options that run the stage, each alone.
std::string options_for(const StageInfo& stage, const Features& features) {
    std::vector<std::string> options;
    for (const Feature feature : all_features()) {
        Features more = features;
        more.set(feature, "forced");
        if (stage.unwanted(more)) continue;
        options.push_back(feature == Feature::multisampled ? "--samples 4" : fmt::format("--force {}", name(feature)));
    }
    return options.empty() ? "--force all" : fmt::format("{}", fmt::join(options, " or "));
}

}  // namespace

Result<void> LeftOutNotes::tell(Session& session, const Request& request, const ChoiceChanges& asked) {
    if (use_texts(asked).empty() && set_texts(asked).empty()) return {};
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    for (const SkippedStage& skipped : planned->skipped) {
        const std::vector<std::string> chosen = chosen_of(asked, skipped.stage);
        if (chosen.empty() || !told_.insert(fmt::format("{}", fmt::join(chosen, " "))).second) continue;
        to_stderr("strata: {} {} no effect in frame {}: its stage is left out ({}); {} runs it all the same\n",
                  fmt::join(chosen, " and "), chosen.size() > 1 ? "have" : "has", request.variant.frame, skipped.reason,
                  options_for(info(skipped.stage), planned->features));
    }
    return {};
}

}  // namespace strata
