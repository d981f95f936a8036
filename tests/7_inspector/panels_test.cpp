// Every panel draws whatever there is to draw, without a window.
#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "ui/widgets/keys_list.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

/// Brings every tab to the front once.
void look_at_every_panel(Desk& desk) {
    for (const PanelRow& row : panels()) {
        must(desk.player->click(fmt::format("tabs/{}", row.name)));
        must(desk.player->wait());
        desk.expect_no_conflicts();
    }
}

void look_at_every_panel_of(std::string_view scenario) {
    SCOPED_TRACE(scenario);
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of(scenario));
    must(desk.player->wait());
    ASSERT_EQ(desk.inspector->replayer().error("A"), nullptr) << desk.inspector->replayer().error("A")->sentence;
    EXPECT_EQ(desk.replay()->request.variant.frame, frame_of(scenario));
    look_at_every_panel(desk);
}

std::size_t new_features(const Features& features, const Features& seen) {
    return std::size_t(std::ranges::count_if(all_features(), [&](Feature f) { return features.has(f) && !seen.has(f); }));
}

/// Few scenarios that have every feature between them: always the one that adds the most.
TEST(Panels, EveryPanelDrawsEveryFeatureWithoutTwoWidgetsOfOneName) {
    std::vector<Features> of_scenarios;
    for (const Scenario& scenario : scenarios())
        of_scenarios.push_back(frame_features(scenario.build(0, {.width = 64, .height = 36})));
    Features seen;
    for (;;) {
        const auto best = std::ranges::max_element(of_scenarios, {}, [&](const Features& f) { return new_features(f, seen); });
        if (new_features(*best, seen) == 0) break;
        const std::string_view name = scenarios()[std::size_t(best - of_scenarios.begin())].name;
        for (const Feature feature : all_features())
            if (best->has(feature)) seen.set(feature, std::string(name));
        look_at_every_panel_of(name);
    }
}

TEST(ExhaustivePanels, EveryPanelDrawsEveryScenarioWithoutTwoWidgetsOfOneName) {
    for (const Scenario& scenario : scenarios()) look_at_every_panel_of(scenario.name);
}

TEST(Panels, EveryPanelDrawsEveryTechniqueOfAFrameThatNeedsItsStage) {
    Desk& desk = Desk::clean();
    for (const StageInfo& info : stages()) {
        if (info.scenarios.empty()) continue;
        desk.model().select_frame(frame_of(info.scenarios.front()));
        must(desk.player->wait());
        for (const Technique* technique : techniques_of(info.stage)) {
            SCOPED_TRACE(technique->name);
            desk.model().use(*technique);
            must(desk.player->wait());
            desk.expect_no_conflicts();
            const std::string short_name(technique->name.substr(technique->name.find('/') + 1));
            EXPECT_EQ(desk.said(fmt::format("Techniques/{}/technique", info.name)), short_name);
            const Error* error = desk.inspector->replayer().error("A");
            EXPECT_TRUE(!error || error->fault == Fault::device_lacks) << error->sentence;
        }
        desk.model().reset_all();
    }
}

TEST(Panels, TheTechniquesPanelHasAWidgetForEveryParameter) {
    Desk& desk = Desk::clean();
    for (const auto& [at, choice] : desk.model().choices()) {
        const auto left_out = std::ranges::find(desk.replay()->skipped, at, &SkippedStage::stage);
        if (left_out != desk.replay()->skipped.end()) continue;
        for (const Param& param : choice.technique->params)
            EXPECT_NO_THROW(desk.widget(fmt::format("Techniques/{}/{}/value", name(at), param.name)));
    }
}

TEST(Panels, TheFrameInWhichATechniqueIsChosenHasItsParametersAlone) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("three_panes"));
    must(desk.player->wait());
    const std::string list = "Techniques/transparency/technique";
    must(desk.player->click(list));
    must(desk.player->move(list + "/weighted", .5f, .5f));
    ImGui::GetIO().MouseDown[0] = true;
    must(desk.player->frames(1));
    ImGui::GetIO().MouseDown[0] = false;
    must(desk.player->frames(1));
    const Technique& chosen = *desk.model().choices().at(Stage::transparency).technique;
    ASSERT_EQ(chosen.name, "transparency/weighted");
    std::vector<std::string> shown, expected;
    for (const WidgetRecord& widget : desk.inspector->widgets().records())
        if (widget.path.starts_with("Techniques/transparency/") && widget.path.ends_with("/value")) shown.push_back(widget.path);
    for (const Param& param : chosen.params) expected.push_back(fmt::format("Techniques/transparency/{}/value", param.name));
    EXPECT_THAT(shown, testing::ElementsAreArray(expected));
    must(desk.player->wait());
}

TEST(Panels, AWidgetStaysWhereItIsWhenItsResetArrowAppears) {
    Desk& desk = Desk::clean();
    desk.model().use(*must(find_technique("transparency/weighted")));
    must(desk.player->wait());
    const Param& param = desk.model().choices().at(Stage::transparency).technique->params[0];
    const std::string row = fmt::format("Techniques/transparency/{}", param.name);
    const WidgetRecord slider = desk.widget(row + "/value"), list = desk.widget("Techniques/lighting/technique");
    EXPECT_THROW(desk.widget(row + "/reset"), std::runtime_error);
    const double now = desk.model().choices().at(Stage::transparency).settings.get(param.name);
    desk.model().set(Stage::transparency, param.name, now == param.low ? param.high : param.low);
    must(desk.player->frames(2));
    EXPECT_NO_THROW(desk.widget(row + "/reset"));
    EXPECT_EQ(desk.widget(row + "/value").to.x, slider.to.x);
    desk.model().use(*must(find_technique("lighting/tiled")));
    must(desk.player->frames(2));
    EXPECT_NO_THROW(desk.widget("Techniques/lighting/reset"));
    EXPECT_EQ(desk.widget("Techniques/lighting/technique").to.x, list.to.x);
    must(desk.player->wait());
}

TEST(Panels, AStageThatIsLeftOutSaysWhy) {
    Desk& desk = Desk::clean();
    ASSERT_FALSE(desk.replay()->skipped.empty());
    const SkippedStage& skipped = desk.replay()->skipped.front();
    EXPECT_EQ(desk.said(fmt::format("Frame/left out/{}", name(skipped.stage))), skipped.reason);
}

TEST(Panels, AClickOnAStepShowsWhatItWroteEverywhere) {
    Desk& desk = Desk::clean();
    const auto& steps = desk.replay()->steps;
    const auto makes_images = std::ranges::find_if(steps, [](const PlanRow& row) { return !row.images.empty(); });
    ASSERT_NE(makes_images, steps.end());
    must(desk.player->type("Frame/find", makes_images->name));
    const std::string row = fmt::format("Frame/{}/{} {}", text_of(makes_images->scope), makes_images - steps.begin(),
                                        makes_images->name.substr(makes_images->name.rfind('/') + 1));
    must(desk.player->click(row));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().step, static_cast<std::size_t>(makes_images - steps.begin()));
    EXPECT_THAT(desk.said("Image/image"), HasSubstr(makes_images->images.front()));
    must(desk.player->type("Frame/find", ""));
}

TEST(Panels, MeasuringGivesEveryStepATime) {
    Desk& desk = Desk::clean();
    must(desk.player->click("Frame/measure"));
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Frame/frame"), HasSubstr("ms"));
}

TEST(Panels, F1ListsTheKeysOfEveryPanel) {
    Desk& desk = Desk::clean();
    must(desk.player->key("f1"));
    EXPECT_EQ(desk.said("keys/ctrl+z"), "undo");
    EXPECT_EQ(desk.said("keys/f"), "the whole picture");
    for (const char* gesture : {"click", "wheel", "drag", "right drag", "alt+drag"})
        EXPECT_NO_THROW(desk.said(fmt::format("keys/{}", gesture)));
    for (const WidgetRecord& record : desk.inspector->widgets().records()) {
        const bool fits = record.visible && record.to.y < 800 && record.to.x < 1280;
        EXPECT_TRUE(fits || !record.path.starts_with("keys/")) << record.path;
    }
    desk.expect_no_conflicts();
    must(desk.player->key("escape"));
    EXPECT_THROW(desk.said("keys/f"), std::runtime_error);
}

TEST(Panels, KeysOfOneMeaningAreOneRowOfTheList) {
    const KeyRow rows[] = {{"left", "move"}, {"right", "move"}, {"f", "fit"},  {"1", "view"},
                           {"2", "view"},    {"3", "view"},     {"4", "view"}, {"5", "view"}};
    const auto made = joined(rows);
    ASSERT_EQ(made.size(), 3u);
    EXPECT_EQ(made[0].keys, "Left  Right");
    EXPECT_EQ(made[1].keys, "F");
    EXPECT_EQ(made[2].keys, "1 \xe2\x80\xa6 5");
    EXPECT_EQ(made[2].first, "1");
}

TEST(Panels, AFrameThatIsNotThereShowsASentenceAndKeepsThePicture) {
    Desk& desk = Desk::clean();
    const auto before = desk.replay();
    desk.model().select_frame(scenarios().size());
    must(desk.player->wait());
    const Error* error = desk.inspector->replayer().error("A");
    ASSERT_NE(error, nullptr);
    EXPECT_THAT(*error, FailsWith("capture.no_frame", Field("frame", scenarios().size())));
    EXPECT_THAT(desk.said("status/error"), HasSubstr(error->sentence));
    EXPECT_EQ(desk.replay(), before);
    EXPECT_EQ(desk.inspector->log().back().text, error->sentence);
    must(desk.player->move("status/error", .1f, .5f));
    must(desk.player->frames(60));
    EXPECT_THAT(desk.said("help"), HasSubstr("capture.no_frame: ")) << "its id is its help";
}

}  // namespace
}  // namespace strata::ui
