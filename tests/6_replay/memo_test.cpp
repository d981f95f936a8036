// Changing one technique executes it and what follows, nothing before it, and the picture is the one a fresh run gives.
#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "replay/session/memo.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Techniques of a stage by their place on the list: a test of the house names none.
std::string technique_of(Stage stage, std::size_t place) { return std::string(techniques_of(stage)[place]->name); }

TEST(Memo, ASecondEqualRunExecutesOnlyWhatFeedsBuffers) {
    const auto session = scenario_session("three_panes");
    const auto first = must(session->run({}));
    const auto second = must(session->run({}));
    EXPECT_EQ(first.passes_from_memo, 0u);
    EXPECT_GT(second.passes_from_memo, 0u);
    EXPECT_LT(second.steps.size(), first.steps.size());
    EXPECT_EQ(hash_of(first.images.at("display")), hash_of(second.images.at("display")));
}

/// Scopes of the steps a run executed that are passes standing before a stage, the memo's own copies aside.
std::vector<std::string> executed_before(Stage stage, const Run& run) {
    std::vector<std::string> scopes;
    for (const StepRecord& step : run.steps) {
        if (step.scope.kind == ScopeKind::pass && step.scope.at < stage)
            scopes.push_back(text_of(step.scope) + " / " + step.name);
    }
    return scopes;
}

std::string text(const std::vector<CounterRecord>& counters) {
    std::string text;
    for (const CounterRecord& c : counters) text += fmt::format(" {} {} {}", c.technique, c.name, c.value);
    return text;
}

TEST(Memo, AnotherTransparencyExecutesNoStepOfAnyStageBeforeIt) {
    const auto session = scenario_session("glass_and_smoke");
    std::optional<std::vector<CounterRecord>> earlier;
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        const auto run = must(session->run({.choices = chosen({std::string(technique->name)})}));
        EXPECT_EQ(executed_before(Stage::transparency, run).empty(), earlier.has_value()) << technique->name;
        std::vector<CounterRecord> now;  // they are reported as if the stages had run again
        for (const CounterRecord& counter : run.counters)
            if (must(find_technique(counter.technique))->stage < Stage::transparency) now.push_back(counter);
        const auto equal = [](const CounterRecord& a, const CounterRecord& b) {
            return a.technique == b.technique && a.name == b.name && a.value == b.value;
        };
        if (earlier) {
            EXPECT_TRUE(std::ranges::is_permutation(*earlier, now, equal))
                << technique->name << text(*earlier) << " became" << text(now);
        }
        earlier = now;
    }
}

TEST(Memo, APictureMadeWithItIsThePictureOfAFreshRun) {
    const auto session = scenario_session("three_panes");
    must(session->run({.choices = chosen({technique_of(Stage::transparency, 0)})}));
    const auto other = must(session->run({.choices = chosen({technique_of(Stage::transparency, 1)})}));
    session->forget_memo();
    const auto fresh = must(session->run({.choices = chosen({technique_of(Stage::transparency, 1)})}));
    EXPECT_EQ(other.passes_executed, 2u);  // transparency and what stands after it
    EXPECT_EQ(hash_of(other.images.at("display")), hash_of(fresh.images.at("display")));
}

TEST(Memo, TimingExecutesWhatRequestsShareOncePerRepeat) {
    const auto session = scenario_session("glass_and_smoke");
    std::vector<Request> requests;
    for (const std::size_t place : {0u, 1u, 2u})
        requests.push_back({.choices = chosen({technique_of(Stage::transparency, place)})});
    const auto runs = must(session->time(requests, 3));
    ASSERT_EQ(runs.size(), requests.size());
    const auto gbuffer = [](const auto& run) { return run.stage_ms.at("gbuffer"); };
    for (std::size_t i = 0; i < runs.size(); ++i) {
        for (const StepRecord& step : runs[i].steps) ASSERT_TRUE(step.ms && step.ms->repeats == 3) << step.name;
        EXPECT_EQ(gbuffer(runs[i]).median, gbuffer(runs[0]).median);  // one measurement, not one each
        session->forget_memo();
        const auto fresh = must(session->run(requests[i]));
        EXPECT_EQ(hash_of(runs[i].images.at("display")), hash_of(fresh.images.at("display")));
        EXPECT_EQ(runs[i].counters.size(), fresh.counters.size());
    }
    EXPECT_NE(runs[0].stage_ms.at("transparency").median, runs[1].stage_ms.at("transparency").median);
}

TEST(Memo, AJudgmentIsTheSameWhateverWasJudgedBefore) {
    const auto fresh = scenario_session("three_panes"), used = scenario_session("three_panes");
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        const Request request{.choices = chosen({std::string(technique->name)})};
        fresh->forget_memo();
        const auto a = must(fresh->judge(request, Stage::transparency)), b = must(used->judge(request, Stage::transparency));
        const auto again = must(used->judge(request, Stage::transparency));
        EXPECT_EQ(a.compared, b.compared) << technique->name;
        EXPECT_EQ(a.model_rmse, b.model_rmse) << technique->name;
        EXPECT_EQ(a.model_rmse, again.model_rmse) << technique->name;
        ASSERT_EQ(a.technique_errors.size(), b.technique_errors.size());
        for (std::size_t i = 0; i < a.technique_errors.size(); ++i)
            EXPECT_EQ(a.technique_errors[i].value, b.technique_errors[i].value) << technique->name;
        must(used->judge(request, Stage::gbuffer));  // forgets what transparency found, not what it gave
        EXPECT_EQ(a.model_rmse, must(used->judge(request, Stage::transparency)).model_rmse) << technique->name;
    }
}

TEST(Memo, ASettingIsPartOfTheKey) {
    const auto session = scenario_session("three_panes");
    const Technique* with_parameter = nullptr;
    for (const Technique* technique : techniques_of(Stage::transparency))
        if (!technique->params.empty()) with_parameter = technique;
    ASSERT_NE(with_parameter, nullptr);
    const Param& param = with_parameter->params.front();
    const double other = param.fallback == param.low ? param.high : param.low;
    const Request plain{.choices = chosen({std::string(with_parameter->name)})};
    must(session->run(plain));
    Request changed = plain;
    set(changed, fmt::format("{}={}", param.name, other));
    const auto run = must(session->run(changed));
    bool executed = false;
    for (const StepRecord& step : run.steps)
        executed |= step.scope.kind == ScopeKind::pass && step.scope.at == Stage::transparency;
    EXPECT_TRUE(executed);
}

TEST(Memo, CountersOfKeptPassesAreReportedAgain) {
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
