#include "replay/session/frame_plan.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/nearest_name.h"
#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {
namespace {

/// A recorded value as the text `--set` would take.
std::string text(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// The stage's technique and settings as the capture has them. Fails with what is not understood and the known names.
Result<Choice> recorded_choice(const StageChoice& recorded, Stage stage) {
    const auto technique = technique_called(recorded.technique, stage);
    if (!technique) return technique.error();
    Choice choice{*technique, Settings((*technique)->params)};
    for (const Setting& setting : recorded.settings)
        if (const auto kept = choice.settings.set(setting.key, text(setting.value)); !kept) return kept.error();
    return choice;
}

/// Follows the capture where the changes give a stage no other technique.
Result<void> apply_recorded(const Frame& frame, const ChoiceChanges& changes, Choices& choices) {
    std::array<const StageChoice*, std::size(stage_names)> seen = {};
    for (const StageChoice& recorded : frame.recorded_with) {
        const auto refused = [&](Error error) {
            error.fault = Fault::bad_input;  // the capture says it, and nobody on the command line
            return within(std::move(error), "the recorded choice for '{stage}'", recorded.stage);
        };
        const auto stage = stage_called(recorded.stage);
        if (!stage) return refused(stage.error());
        if (changes.technique(*stage)) continue;
        const StageChoice*& earlier = seen[static_cast<std::size_t>(*stage)];
        if (earlier)
            return refused(fail(Fault::usage, "technique.two_of_a_stage",
                                "{technique} and {other} are of one stage, which takes one technique", earlier->technique,
                                recorded.technique));
        earlier = &recorded;
        auto choice = recorded_choice(recorded, *stage);
        if (!choice)
            return advised(refused(choice.error()), "pass --use {stage}/TECHNIQUE to replay it with another technique",
                           name(*stage));
        choices[*stage] = *std::move(choice);
    }
    return {};
}

/// Of a setting that no chosen technique has; `known`: the parameters of those it might have meant.
Error no_such_parameter(const Choices& choices, const SettingChange& change, std::span<const std::string_view> known) {
    const auto owner = std::ranges::find_if(techniques(), [&](const Technique& one) { return change.fits(one); });
    if (owner == techniques().end() && change.technique)
        return fail(Fault::usage, "settings.unknown", "{technique} has no parameter '{setting}'{suggestion}",
                    change.technique->name, change.key, did_you_mean(change.key, known));
    if (owner == techniques().end())
        return fail(Fault::usage, "settings.unknown", "no technique has a parameter '{setting}'{suggestion}", change.key,
                    did_you_mean(change.key, known));
    const auto chosen = choices.find(owner->stage);
    return fail(Fault::usage, "settings.of_another_technique",
                "{chosen} is the chosen technique of {stage} and has no parameter '{setting}'; {technique} has it: pass --use "
                "{use} instead",
                chosen == choices.end() ? "nothing" : chosen->second.technique->name, name(owner->stage), change.key, owner->name,
                owner->name);
}

Result<void> apply(Choices& choices, const SettingChange& change) {
    bool found = false;
    std::vector<std::string_view> known;
    for (auto& [stage, choice] : choices) {
        if (change.technique && choice.technique != change.technique) continue;
        for (const Param& param : choice.technique->params) known.push_back(param.name);
        if (!change.fits(*choice.technique)) continue;
        const auto set = [&](const auto& value) { return choice.settings.set(change.key, value); };
        if (const auto done = std::visit(set, change.value); !done) return done.error();
        found = true;
    }
    return found ? Result<void>() : Result<void>(no_such_parameter(choices, change, known));
}

/// Declares what the technique does at one place of the frame, in a scope of its own.
DeclaredPass pass(Graph& graph, FrameImages& images, const Choice& choice, const StageWork& what) {
    const Technique& technique = *choice.technique;
    graph.enter({ScopeKind::pass, technique.stage, what.at, std::string(technique.name)}, technique.counter_bytes);
    const auto scope = static_cast<std::uint32_t>(graph.scopes().size() - 1);
    DeclaredPass declared{&technique, what.at, scope, images};
    what.declare(graph, images, choice.settings);
    return declared;
}

/// Every pass in the order of the frame: what earlier stages finish there, the stage's own technique, what later ones prepare.
std::vector<std::pair<const Choice*, StageWork>> passes_at(Stage stage, const Choices& wanted) {
    std::vector<std::pair<const Choice*, StageWork>> passes;
    for (const auto& [own, choice] : wanted) {
        if (own == stage) passes.push_back({&choice, {stage, choice.technique->declare}});
        for (const StageWork& other : choice.technique->at_other_stages)
            if (other.at == stage) passes.push_back({&choice, other});
    }
    return passes;
}

bool works_at(const Technique& technique, Stage stage) {
    return std::ranges::count(technique.at_other_stages, stage, &StageWork::at) > 0;
}

/// Why a stage without techniques of its own has nothing to do, or nothing where a chosen one of another stage works there.
std::optional<std::string> unserved(Stage stage, const Choices& choices) {
    if (std::ranges::any_of(choices, [&](const auto& entry) { return works_at(*entry.second.technique, stage); })) return {};
    std::vector<std::string_view> able;
    for (const Technique& technique : techniques())
        if (works_at(technique, stage)) able.push_back(technique.name);
    if (able.empty()) return "no technique does its work";
    return fmt::format("no chosen technique does its work; {} would", fmt::join(able, " or "));
}

}  // namespace

bool has_param(const Technique& technique, std::string_view key) {
    return std::ranges::count(technique.params, key, &Param::name) > 0;
}

bool SettingChange::fits(const Technique& one) const { return (!technique || technique == &one) && has_param(one, key); }

void ChoiceChanges::use(const Technique& technique) { techniques[static_cast<std::size_t>(technique.stage)] = &technique; }

void ChoiceChanges::drop(Stage stage) {
    techniques[static_cast<std::size_t>(stage)] = nullptr;
    std::erase_if(settings, [&](const SettingChange& change) { return change.technique && change.technique->stage == stage; });
}

Result<Choices> choose(const Frame& frame, const ChoiceChanges& changes) {
    Choices choices;
    for (const StageInfo& stage : stages())
        if (const auto known = techniques_of(stage.stage); !known.empty())
            choices[stage.stage] = {known.front(), Settings(known.front()->params)};
    if (const auto applied = apply_recorded(frame, changes, choices); !applied) return applied.error();
    for (const Technique* technique : changes.techniques)
        if (technique) choices[technique->stage] = {technique, Settings(technique->params)};
    for (const SettingChange& change : changes.settings)
        if (const auto done = apply(choices, change); !done) return done.error();
    return choices;
}

std::optional<Error> beyond_device(const Choice& choice, const FrameImages& images) {
    const Technique& technique = *choice.technique;
    for (const Capability needed : technique.needs)
        if (!has(images.capabilities, needed))
            return fail(Fault::device_lacks, "device.lacks_feature",
                        "{technique} needs {feature}, which this device does not have", technique.name, name(needed));
    if (!technique.beyond_device) return std::nullopt;
    return technique.beyond_device(images, choice.settings);
}

Result<DeclaredFrame> declare_frame(Graph& graph, FrameImages& images, const Choices& choices, const Capabilities& device,
                                    const AfterPass& after) {
    DeclaredFrame frame;
    Choices wanted;
    images.capabilities = device;
    for (const StageInfo& stage : stages()) {
        const auto choice = choices.find(stage.stage);
        if (const auto reason = stage.unwanted(*images.features)) {
            frame.skipped.push_back({stage.stage, *reason});
        } else if (choice == choices.end()) {
            if (const auto why = unserved(stage.stage, choices)) frame.skipped.push_back({stage.stage, *why});
        } else {
            if (const auto why = beyond_device(choice->second, images)) return *why;
            if (const auto why = stage.beyond_device ? stage.beyond_device(images) : std::nullopt) return *why;
            wanted.insert(*choice);
        }
    }
    for (const StageInfo& stage : stages()) {
        for (const auto& [choice, what] : passes_at(stage.stage, wanted)) {
            frame.passes.push_back(pass(graph, images, *choice, what));
            if (after) after(frame.passes.back());
        }
    }
    return frame;
}

}  // namespace strata
