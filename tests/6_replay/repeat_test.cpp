// Equal runs give equal bits, and every step of every plan can be looked at.
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

TEST(Repeat, TwentyReplaysGiveEqualBits) {
    const auto session = scenario_session("interpenetrating_panes", 4);
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        const Request request{.choices = chosen({std::string(technique->name)}), .outputs = {"color", "display"}};
        const auto first = must(session->run(request));
        for (int repeat = 1; repeat < 20; ++repeat) {
            session->forget_memo();
            const auto again = must(session->run(request));
            for (const auto& [name, image] : first.images)
                ASSERT_EQ(hash_of(image), hash_of(again.images.at(name)))
                    << technique->name << " " << name << " repeat " << repeat;
        }
    }
}

TEST(Peek, EveryImageOfEveryStepCanBeLookedAt) {
    const auto session = scenario_session("three_panes");
    const auto planned = must(session->plan({}));
    std::size_t looked = 0;
    for (std::size_t step = 0; step < planned.plan.steps.size(); ++step)
        for (const Attachment& attachment : planned.plan.steps[step].step.attachments) {
            const std::string& name = planned.plan.images[attachment.image.id].name;
            if (!writes(attachment.access)) continue;
            const HostImage image = must(session->peek({}, step, name));
            EXPECT_EQ(image.texels.size(), bytes(image.shape)) << name;
            ++looked;
        }
    EXPECT_GE(looked, 3u);
}

TEST(Until, StopsAfterTheNamedStep) {
    const auto session = scenario_session("three_panes");
    EXPECT_FALSE(session->run({.until = "no such step"}));
    EXPECT_TRUE(session->run({.until = "gbuffer"}));
}

TEST(Timing, EveryStepHasAMedianAndASpread) {
    const auto session = scenario_session("three_panes");
    const std::vector<Request> requests(2);
    const auto runs = must(session->time(requests, 3));
    ASSERT_EQ(runs.size(), 2u);
    for (const StepRecord& step : runs[0].steps) {
        ASSERT_TRUE(step.ms);
        EXPECT_EQ(step.ms->repeats, 3u);
        EXPECT_GE(step.ms->low, 0);
    }
    EXPECT_GT(runs[0].frame_ms->median, 0);
    ASSERT_TRUE(runs[1].empty_step_ms);
    EXPECT_EQ(runs[1].empty_step_ms->repeats, 3u);
    EXPECT_LT(runs[1].empty_step_ms->median, runs[1].frame_ms->median / double(runs[1].steps.size()));
    EXPECT_FALSE(runs[0].whole_frame_ms) << "nobody asked";
}

TEST(Timing, OfAFrameAsAWholeHasNothingBetweenItsSteps) {
    const auto session = scenario_session("three_panes");
    const Request request{.whole = true};
    const auto run = must(session->time(std::span(&request, 1), 3)).front();
    ASSERT_TRUE(run.whole_frame_ms);
    EXPECT_EQ(run.whole_frame_ms->repeats, 3u);
    EXPECT_GT(run.whole_frame_ms->low, run.empty_step_ms->median);
}

/// In a run of its own: none of the timed ones has queries for it.
TEST(Timing, CountsHowOftenShadersRun) {
    const auto session = scenario_session("three_panes");
    const auto counts = [&](std::size_t requests, std::size_t repeats) {
        return must(session->time(std::vector<Request>(requests, Request{.counted = true}), repeats)).back().stage_invocations;
    };
    const auto counted = counts(1, 1);
    EXPECT_GE(counted.at("transparency"), 64u * 36);
    EXPECT_EQ(counts(1, 3), counted);
    EXPECT_EQ(counts(2, 2), counted);
    EXPECT_TRUE(must(session->time(std::vector<Request>(1), 1)).front().stage_invocations.empty()) << "nobody asked";
}

/// Else the order that an engine must make in every frame would be free.
TEST(Timing, HoldsWhatTheHostSorts) {
    const auto session = scenario_session("smoke_grenade");
    std::vector<Request> requests(2);
    requests[0] = {.choices = chosen({"transparency/alpha_blend"})};
    requests[1] = {.choices = chosen({"transparency/weighted"})};
    const auto runs = must(session->time(requests, 3));
    const Spread& sorted = runs[0].stage_sort_ms.at("transparency");
    EXPECT_EQ(sorted.repeats, 3u);
    EXPECT_GT(sorted.low, 0);
    EXPECT_TRUE(runs[1].stage_sort_ms.empty());
    for (std::size_t repeat = 0; repeat < 3; ++repeat) {
        double steps = 0;
        for (const StepRecord& step : runs[0].steps)
            if (step.scope.kind == ScopeKind::pass && step.scope.stage == Stage::transparency) steps += step.ms_by_repeat[repeat];
        const double beyond = runs[0].stage_ms_by_repeat.at("transparency")[repeat] - steps;
        EXPECT_GE(beyond, sorted.low * .999);
        EXPECT_LE(beyond, sorted.high * 1.001);
    }
}

}  // namespace
}  // namespace strata
