// Changing one technique executes it and what follows, nothing before it, and the picture is the one a fresh run gives.
#include <algorithm>

#include <gtest/gtest.h>

#include "replay/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Techniques of a stage by their place on the list: a test of the house names none.
std::string technique_of(Stage stage, std::size_t place) { return std::string(techniques_of(stage)[place]->name); }

TEST(Memo, ASecondEqualRunExecutesOnlyWhatFeedsBuffers) {
    const auto session = scenario_session("three_panes");
    const auto first = must(session->run({}));
    const auto second = must(session->run({}));
    EXPECT_EQ(first.acts_from_memo, 0u);
    EXPECT_GT(second.acts_from_memo, 0u);
    EXPECT_LT(second.steps.size(), first.steps.size());
    EXPECT_EQ(hash_of(first.images.at("display")), hash_of(second.images.at("display")));
}

TEST(Memo, AnotherTransparencyKeepsEveryStageBeforeIt) {
    const auto session = scenario_session("three_panes");
    must(session->run({.uses = {technique_of(Stage::transparency, 0)}}));
    const auto other = must(session->run({.uses = {technique_of(Stage::transparency, 1)}}));
    for (const StepRecord& step : other.steps) {
        EXPECT_EQ(step.scope.find("gbuffer: "), step.scope.starts_with("memo") ? step.scope.find("gbuffer: ") : std::string::npos)
            << step.scope;
        EXPECT_FALSE(step.scope.starts_with("lighting: ")) << step.scope;
    }
    session->forget_memo();
    const auto fresh = must(session->run({.uses = {technique_of(Stage::transparency, 1)}}));
    EXPECT_EQ(hash_of(other.images.at("display")), hash_of(fresh.images.at("display")));
}

TEST(Memo, ASettingIsPartOfTheKey) {
    const auto session = scenario_session("three_panes");
    const Technique* with_parameter = nullptr;
    for (const Technique* technique : techniques_of(Stage::transparency))
        if (!technique->params.empty()) with_parameter = technique;
    ASSERT_NE(with_parameter, nullptr);
    const Param& param = with_parameter->params.front();
    const double other = param.fallback == param.low ? param.high : param.low;
    const Request plain{.uses = {std::string(with_parameter->name)}};
    must(session->run(plain));
    Request changed = plain;
    changed.sets = {fmt::format("{}={}", param.name, other)};
    const auto run = must(session->run(changed));
    bool executed = false;
    for (const StepRecord& step : run.steps) executed = executed || step.scope.starts_with("transparency: ");
    EXPECT_TRUE(executed);
}

TEST(Memo, CountersOfKeptActsAreReportedAgain) {
    const auto session = scenario_session("three_panes");
    const auto first = must(session->run({}));
    const auto second = must(session->run({}));
    for (const CounterRecord& counter : first.counters) {
        const auto same = [&](const CounterRecord& c) { return c.technique == counter.technique && c.name == counter.name; };
        const auto found = std::ranges::find_if(second.counters, same);
        ASSERT_NE(found, second.counters.end()) << counter.technique << " " << counter.name;
        EXPECT_EQ(found->value, counter.value) << counter.technique << " " << counter.name;
    }
}

}  // namespace
}  // namespace strata
