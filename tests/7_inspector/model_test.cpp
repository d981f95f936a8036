// What is edited, and that every edit is a command line and can be undone.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include "capture_format/frame/stage_choice.h"
#include "passes/registry.h"
#include "passes/scene/scene_facts.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/cli/verb_options.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// What the command line's own parser makes of a line.
Request parsed(const std::string& line) {
    auto words = must(parse_script(line, "a command line")).front().words;
    CLI::App app;
    CLI::App* replay = app.add_subcommand("replay");
    OpenOptions open;
    ChoiceOptions choices;
    std::string frames;
    std::vector<std::string> outputs = {"display"};
    add_options(*replay, open);
    add_options(*replay, choices);
    replay->add_option("--frames", frames);
    replay->add_option("--outputs", outputs)->delimiter(',');
    EXPECT_EQ(words.front(), "strata");
    words.erase(words.begin());
    std::ranges::reverse(words);
    app.parse(words);
    Request request = must(request_of(choices));
    request.variant.frame = must(frame_indices(frames, 1000)).front();
    std::ranges::sort(outputs);
    request.outputs = outputs;
    return request;
}

FrameFacts facts(std::size_t index = 0) {
    FrameFacts made{.index = index};
    made.bare.view.width = 96;
    return made;
}

Model known_model() {
    Model model("a capture's name.strata", {}, {});
    model.know(facts());
    return model;
}

/// A stage whose default technique has a parameter that is a number, and that parameter.
std::pair<strata::Stage, Param> parameter(const Model& model) {
    for (const auto& [stage, choice] : model.choices())
        for (const Param& param : choice.technique->params)
            if (param.choices.empty() && param.scalar == Scalar::real) return {stage, param};
    throw std::runtime_error("no technique has a number");
}

double other_value(const Param& param) { return param.fallback == param.low ? param.high : param.low; }

TEST(Model, NothingIsEditedAtFirst) {
    const Model model = known_model();
    EXPECT_EQ(model.edits(), Edits());
    EXPECT_FALSE(model.can_undo());
    EXPECT_EQ(model.command_line(), "strata replay 'a capture'\\''s name.strata' --frames 0");
}

TEST(Model, AValueThatIsSetIsOneSettingMoreAndNoneWhenItIsBack) {
    Model model = known_model();
    const auto [stage, param] = parameter(model);
    model.set(stage, param.name, other_value(param));
    EXPECT_TRUE(model.is_changed(stage, param.name));
    EXPECT_EQ(model.edits().choices.settings.size(), 1u);
    model.reset(stage, param.name);
    EXPECT_THAT(model.edits().choices.settings, IsEmpty());
}

TEST(Model, ASliderThatIsPulledIsOneStepOfUndo) {
    Model model = known_model();
    const auto [stage, param] = parameter(model);
    for (const double share : {.25, .5, .75}) model.set(stage, param.name, param.low + share * (param.high - param.low));
    model.settle();
    model.set(stage, param.name, param.high);
    model.undo();
    EXPECT_DOUBLE_EQ(model.choices().at(stage).settings.get(param.name), param.low + .75 * (param.high - param.low));
    model.undo();
    EXPECT_DOUBLE_EQ(model.choices().at(stage).settings.get(param.name), param.fallback);
    EXPECT_FALSE(model.can_undo());
    model.redo();
    model.redo();
    EXPECT_DOUBLE_EQ(model.choices().at(stage).settings.get(param.name), param.high);
}

TEST(Model, EveryTechniqueAndEveryParameterComesBackFromTheCommandLine) {
    for (const Technique& technique : techniques()) {
        Model model = known_model();
        model.use(technique);
        for (const Param& param : technique.params)
            model.set(technique.stage, param.name, param.choices.empty() ? other_value(param) : double(param.choices.size() - 1));
        model.force({Feature::fog});
        model.set_samples(4);
        SCOPED_TRACE(model.command_line());
        EXPECT_EQ(parsed(model.command_line()), model.request());
        EXPECT_EQ(must(choose(model.facts().bare, model.request().choices)).at(technique.stage).settings,
                  model.choices().at(technique.stage).settings);
    }
}

TEST(Model, WhatWasRecordedIsWhatAResetReturnsTo) {
    FrameFacts recorded = facts();
    const Model defaults = known_model();
    const auto [stage, param] = parameter(defaults);
    const Technique& technique = *defaults.choices().at(stage).technique;
    recorded.bare.recorded_with = {
        {std::string(name(stage)), std::string(technique.name), {{std::string(param.name), other_value(param)}}}};
    Model model("x.strata", {}, {});
    model.know(recorded);
    EXPECT_EQ(model.base_value(stage, param.name), other_value(param));
    EXPECT_EQ(model.edits(), Edits());
    model.set(stage, param.name, param.fallback);
    EXPECT_EQ(model.edits().choices.settings.size(), 1u);
    model.reset(stage);
    EXPECT_EQ(model.edits(), Edits());
}

TEST(Model, SettingsThatAnotherFramesTechniqueDoesNotHaveAreDropped) {
    Model model("x.strata", {}, {.choices = chosen({}, {"no_such_parameter=1"})});
    model.know(facts());
    EXPECT_THAT(model.edits().choices.settings, IsEmpty());
}

TEST(Undo, ReturnsByKeyToWhatWasShownBefore) {
    Desk& desk = Desk::clean();
    const auto before = desk.replay()->run.choices;
    const auto [at, param] = parameter(desk.model());
    desk.model().set(at, param.name, other_value(param));
    must(desk.player->wait());
    must(desk.player->key("ctrl+z"));
    must(desk.player->wait());
    EXPECT_EQ(desk.replay()->run.choices, before);
    EXPECT_EQ(desk.model().edits(), Edits());
}

}  // namespace
}  // namespace strata::ui
