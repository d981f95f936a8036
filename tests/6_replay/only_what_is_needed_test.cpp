// Only what the scene calls for: what is left out costs nothing, and forcing it on changes nothing.
#include <gtest/gtest.h>

#include <algorithm>

#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

class EveryScenario : public testing::TestWithParam<std::string> {};

std::vector<std::string> scenario_names() {
    std::vector<std::string> names;
    for (const Scenario& scenario : scenarios()) names.emplace_back(scenario.name);
    return names;
}

void expect_nothing_of(const SkippedStage& skipped, const Run& run) {
    EXPECT_FALSE(skipped.reason.empty());
    EXPECT_FALSE(run.stage_bytes.contains(std::string(name(skipped.stage)))) << name(skipped.stage);
    for (const StepRecord& step : run.steps)
        EXPECT_FALSE(step.scope.kind == ScopeKind::pass && step.scope.stage == skipped.stage) << text_of(step.scope);
    for (const CounterRecord& counter : run.counters)
        EXPECT_NE(counter.technique.substr(0, counter.technique.find('/')), name(skipped.stage));
}

TEST_P(EveryScenario, LeavesOutStagesWholeAndForcingThemChangesNoPixel) {
    Request request = on_scenario(GetParam());
    request.outputs = {"color", "display"};
    request.once = true;  // a stage that is kept from another run has no steps
    const auto plain = must(session_of_scenarios().run(request));
    for (const SkippedStage& skipped : plain.skipped) expect_nothing_of(skipped, plain);
    request.once = false;
    request.variant.force.assign(all_features().begin(), all_features().end());
    const auto all = must(session_of_scenarios().run(request));
    for (const auto& [name, image] : plain.images) EXPECT_EQ(hash_of(image), hash_of(all.images.at(name))) << name;
}

TEST(OnlyWhatIsNeeded, AnEmptyFrameLeavesOutMostStages) {
    const auto session = scenario_session("empty");
    const auto run = must(session->run({}));
    EXPECT_GE(run.skipped.size(), 8u);
}

TEST(OnlyWhatIsNeeded, AStageWithoutTechniquesOfItsOwnIsServedByAChosenOne) {
    const auto reason = [](const char* technique) -> std::string {
        Request request = on_scenario("three_cards");
        request.choices = chosen({technique});
        const auto run = must(session_of_scenarios().run(request));
        const auto skipped = std::ranges::find(run.skipped, Stage::extinction, &SkippedStage::stage);
        return skipped == run.skipped.end() ? "" : skipped->reason;
    };
    EXPECT_EQ(reason("transparency/alpha_blend"), "no chosen technique does its work; transparency/voxel would");
    EXPECT_EQ(reason("transparency/voxel"), "");
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryScenario, testing::ValuesIn(scenario_names()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace strata
