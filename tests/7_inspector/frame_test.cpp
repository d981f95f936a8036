// The frame as rows and as a timeline: plain values, and what the panel makes of them.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/plural.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/frame/timeline.h"

namespace strata::ui {
namespace {

using testing::AllOf;
using testing::HasSubstr;

StepRecord timed(Stage stage, std::string technique, std::string name, std::vector<double> ms) {
    return {{ScopeKind::pass, stage, stage, std::move(technique)}, std::move(name), spread_of(ms), ms};
}

/// Two passes: shadows of two steps, lighting of one.
FrameTimes times() {
    FrameTimes made;
    made.run.steps = {timed(Stage::shadows, "shadows/pcf", "shadows/pcf/draw.vert", {1, 2, 6}),
                      timed(Stage::shadows, "shadows/pcf", "shadows/pcf/blur.comp", {2, 1, 1}),
                      timed(Stage::lighting, "lighting/tiled", "lighting/tiled/light.comp", {4, 4, 4})};
    made.run.frame_ms = spread_of(std::vector<double>{7, 7, 11});
    return made;
}

PlanRow row(const StepRecord& step) {
    return {.scope = step.scope, .name = step.name, .images = {}, .barriers = 2, .made_bytes = 10, .alive_bytes = 30};
}

/// The frame that was measured, of which the memo had the shadows.
Replay replay_of(const FrameTimes& measured) {
    Replay made;
    for (const StepRecord& step : measured.run.steps) made.steps.push_back(row(step));
    made.steps[1].alive_bytes = 50;
    made.run.steps = {measured.run.steps.back()};
    return made;
}

TEST(FrameRows, APassIsTheSumOfItsStepsRepeatByRepeat) {
    const FrameTimes measured = times();
    const FrameRows rows = frame_rows(replay_of(measured), &measured);
    ASSERT_EQ(rows.passes.size(), 2u);
    const FramePass& shadows = rows.passes.front();
    // Sums 3, 3, 7: their median is 3 and two of three do not deviate. The steps' own medians are 2 and 1, deviating by 1 and 0.
    ASSERT_TRUE(shadows.ms);
    EXPECT_EQ(shadows.ms->median, 3);
    EXPECT_EQ(shadows.ms->mad, 0);
    EXPECT_EQ(shadows.ms->high, 7);
    EXPECT_EQ(shadows.barriers, 4u);
    EXPECT_EQ(shadows.made_bytes, 20u);
    EXPECT_EQ(shadows.alive_bytes, 50u) << "the most at one of its steps";
    EXPECT_EQ(face_of(shadows.scope), "shadows/pcf");
}

TEST(FrameRows, ToldApartArePassesThatWereExecutedAndPassesThatWereKept) {
    const FrameRows rows = frame_rows(replay_of(times()), nullptr);
    EXPECT_FALSE(rows.passes[0].is_executed);
    EXPECT_TRUE(rows.passes[1].is_executed);
    EXPECT_EQ(executed_text(rows), "1 of 2 passes run, 1 reused");
    EXPECT_FALSE(rows.passes[0].ms) << "nothing was measured";
}

TEST(FrameRows, ATimeStaysWithItsStepThoughOtherStepsCameBeforeIt) {
    const FrameTimes measured = times();
    Replay replay = replay_of(measured);
    PlanRow other = replay.steps[0];
    other.scope.technique = "shadows/moments";
    replay.steps = {other, other, other, replay.steps[2]};
    const FrameRows rows = frame_rows(replay, &measured);
    EXPECT_THAT(rows.timed, testing::ElementsAre(std::nullopt, std::nullopt, std::nullopt, 2u));
    EXPECT_FALSE(rows.passes[0].ms) << "another technique has no time yet";
    EXPECT_EQ(rows.passes[1].ms->median, 4);
    EXPECT_EQ(rows.step_timed_as(2), 3u);
    EXPECT_EQ(rows.step_timed_as(0), std::nullopt);
}

TEST(FrameRows, TheStepBesideAnotherIsTheNextOfThoseThatCount) {
    const std::vector<std::size_t> found{2, 5, 9};
    EXPECT_EQ(step_beside(found, {}, 1), 2u);
    EXPECT_EQ(step_beside(found, {}, -1), 9u);
    EXPECT_EQ(step_beside(found, 2, 1), 5u);
    EXPECT_EQ(step_beside(found, 6, 1), 9u);
    EXPECT_EQ(step_beside(found, 6, -1), 5u);
    EXPECT_EQ(step_beside(found, 9, 1), std::nullopt);
    EXPECT_EQ(step_beside({}, 9, 1), std::nullopt);
}

TEST(FrameRows, ATimeHasTheDigitsThatCount) {
    EXPECT_EQ(time_text({.median = 12.345, .mad = .123}),
              "12.35 \xc2\xb1"
              "0.12");
    EXPECT_EQ(time_text({.median = .0123, .mad = .001}),
              "0.012 \xc2\xb1"
              "0.001");
    EXPECT_EQ(time_text({.median = 123.45}), "123.5");
    EXPECT_EQ(time_text({.median = 12345.6}), "12346");
}

TEST(Timeline, BarsLieEndToEndAndAPassIsAsLongAsItsSteps) {
    const Timeline timeline = timeline_of(times());
    ASSERT_EQ(timeline.steps.size(), 3u);
    ASSERT_EQ(timeline.passes.size(), 2u);
    EXPECT_EQ(timeline.ms, 7);
    EXPECT_EQ(timeline.steps[1].from, 2);
    EXPECT_EQ(timeline.steps[1].to, 3);
    EXPECT_EQ(timeline.passes[0].to, timeline.passes[1].from);
    EXPECT_EQ(timeline.passes[1].to, timeline.ms);
    EXPECT_THAT(timeline.steps[2].help, AllOf(HasSubstr("lighting/tiled/light.comp"), HasSubstr("4.00 ms, 57.1 % of the frame")));
    EXPECT_EQ(bar_at(timeline.steps, 2.5), &timeline.steps[1]);
    EXPECT_EQ(bar_at(timeline.steps, 3), &timeline.steps[2]);
    EXPECT_EQ(bar_at(timeline.steps, -.1), nullptr);
    EXPECT_EQ(bar_at(timeline.steps, 7.5), nullptr);
}

TEST(Timeline, WhatIsUnderThePointerStaysThereWhileItZoomsAndNothingBeyondTheFrameIsSeen) {
    AxisRange seen{0, 7};
    seen = zoomed(seen, 7, 2.1, 3);
    EXPECT_NEAR((2.1 - seen.low) / (seen.high - seen.low), .3, 1e-9);
    EXPECT_EQ(panned(seen, 7, -100).low, 0);
    EXPECT_EQ(panned(seen, 7, 100).high, 7);
    EXPECT_EQ(zoomed(seen, 7, 2.1, -100), (AxisRange{0, 7}));
    const AxisRange deepest = zoomed(seen, 7, 2.1, 100);
    EXPECT_GT(deepest.high, deepest.low);
    const AxisRange moved = brought_into_sight(deepest, 7, {.stage = Stage::lighting, .from = 3, .to = 7});
    EXPECT_EQ(moved, (AxisRange{3, 7}));
    EXPECT_EQ(brought_into_sight(moved, 7, {.stage = Stage::lighting, .from = 4, .to = 5}), moved);
}

// ---- The panel

std::string label_of(const Replay& replay, std::size_t step) {
    return fmt::format("{} {}", step, short_name(replay.steps[step].name));
}
std::string path_of(const Replay& replay, std::size_t step) {
    return fmt::format("Frame/{}/{}", text_of(replay.steps[step].scope), label_of(replay, step));
}

bool has(Desk& desk, const std::string& path) {
    return std::ranges::find(desk.inspector->widgets().records(), path, &WidgetRecord::path) !=
           desk.inspector->widgets().records().end();
}

/// The first step in the second half of the frame that writes an image.
std::size_t some_step(const Replay& replay) {
    const auto begin = replay.steps.begin() + static_cast<std::ptrdiff_t>(replay.steps.size() / 2);
    const auto found = std::find_if(begin, replay.steps.end(), [](const PlanRow& row) { return !row.images.empty(); });
    return static_cast<std::size_t>(found - replay.steps.begin());
}

/// The desk with this capture's frame measured and everything collapsed.
Desk& timed_desk() {
    Desk& desk = Desk::clean();
    must(desk.player->click("Frame/measure"));
    must(desk.player->wait());
    must(desk.player->click("Frame/collapse all"));
    return desk;
}

TEST(FramePanel, MarksWhatAChangeHasExecutedAndKeepsTheMarksAfterMeasuring) {
    Desk& desk = timed_desk();
    desk.model().select_frame(frame_of("glass_and_smoke"));
    must(desk.player->click("Frame/measure"));
    must(desk.player->wait());
    const Technique* before = desk.model().choices().at(Stage::transparency).technique;
    // Measuring has executed everything and kept nothing: the first change fills the memo, the second finds it.
    int changes = 0;
    for (const Technique* other : techniques_of(Stage::transparency)) {
        if (other == before || changes == 2) continue;
        desk.model().use(*other);
        must(desk.player->wait());
        ++changes;
    }
    const FrameRows rows = frame_rows(*desk.replay(), nullptr);
    std::size_t kept = 0;
    for (const FramePass& pass : rows.passes) {
        EXPECT_EQ(desk.said(fmt::format("Frame/{} is", text_of(pass.scope))), pass.is_executed ? "executed" : "kept");
        kept += !pass.is_executed;
    }
    EXPECT_GT(kept, 0u);
    EXPECT_EQ(desk.said("Frame/executed"), executed_text(rows));
    EXPECT_THAT(desk.said("Frame/frame"), HasSubstr("before the last change"));
}

TEST(FramePanel, TheTimelineSaysWhatIsUnderThePointerAndAClickSelectsIt) {
    Desk& desk = timed_desk();
    EXPECT_THAT(desk.said("Frame/timeline"), HasSubstr("0.00 to "));
    must(desk.player->move("Frame/timeline", .999f, .5f));
    const auto replay = desk.replay();
    const std::size_t last = replay->steps.size() - 1;
    EXPECT_THAT(desk.said("Frame/timeline"), AllOf(HasSubstr(replay->steps[last].name), HasSubstr("% of the frame")));
    must(desk.player->pull(0, 0));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().step, last);
    EXPECT_THAT(replay->steps[last].images, testing::Contains(desk.model().image.name));
    EXPECT_TRUE(desk.widget(path_of(*replay, last)).visible) << "it is opened and scrolled to in the tree";
    desk.expect_no_conflicts();
}

TEST(FramePanel, TheWheelZoomsTheTimelineAndADoubleClickShowsAllOfIt) {
    Desk& desk = timed_desk();
    const std::string all = desk.said("Frame/timeline");
    must(desk.player->move("Frame/timeline", .5f, .5f));
    must(desk.player->wheel(5));
    EXPECT_THAT(desk.said("Frame/timeline"), testing::Not(HasSubstr("0.00 to ")));
    const auto step_before = desk.model().step;
    must(desk.player->pull(40, 0));
    EXPECT_EQ(desk.model().step, step_before) << "pulling is no click";
    must(desk.player->wheel(-20));
    EXPECT_THAT(desk.said("Frame/timeline"), HasSubstr(all.substr(0, all.find(" ms"))));
}

TEST(FramePanel, CtrlUpAndDownMoveTheSelectedStepThroughThoseThatAreFound) {
    Desk& desk = timed_desk();
    const auto replay = desk.replay();
    const std::size_t step = some_step(*replay);
    desk.model().step = step;
    must(desk.player->key("ctrl+down"));
    EXPECT_EQ(desk.model().step, step + 1);
    must(desk.player->key("ctrl+up"));
    must(desk.player->key("ctrl+up"));
    EXPECT_EQ(desk.model().step, step - 1);
    EXPECT_TRUE(desk.widget(path_of(*replay, step - 1)).visible);
    EXPECT_FALSE(desk.model().pin) << "the arrows alone move the pinned pixel";
    desk.model().step.reset();
    must(desk.player->type("Frame/find", replay->steps[step].images.front()));
    ASSERT_TRUE(desk.model().step) << "Enter goes to the first that is found";
    const std::size_t first = *desk.model().step;
    EXPECT_THAT(replay->steps[first].images, testing::Contains(HasSubstr(replay->steps[step].images.front())));
    must(desk.player->key("ctrl+up"));
    EXPECT_EQ(desk.model().step, first) << "there is none before the first";
    must(desk.player->type("Frame/find", ""));
    EXPECT_TRUE(desk.widget(path_of(*replay, first)).visible);
}

TEST(FramePanel, CollapsesAndExpandsAllAndByKeysThePassOfTheSelectedStep) {
    Desk& desk = timed_desk();
    const auto replay = desk.replay();
    const std::size_t step = some_step(*replay);
    EXPECT_FALSE(has(desk, path_of(*replay, 0)));
    must(desk.player->click("Frame/expand all"));
    EXPECT_TRUE(has(desk, path_of(*replay, 0)));
    EXPECT_TRUE(has(desk, path_of(*replay, replay->steps.size() - 1)));
    must(desk.player->click("Frame/collapse all"));
    EXPECT_FALSE(has(desk, path_of(*replay, step)));
    desk.model().step = step;
    must(desk.player->frames(2));
    EXPECT_TRUE(has(desk, path_of(*replay, step))) << "what is selected elsewhere comes into sight";
    must(desk.player->key("ctrl+left"));
    EXPECT_FALSE(has(desk, path_of(*replay, step)));
    must(desk.player->key("ctrl+right"));
    EXPECT_TRUE(has(desk, path_of(*replay, step)));
    must(desk.player->type("Frame/find", replay->steps[0].name));
    must(desk.player->type("Frame/find", ""));
    const std::string closed = fmt::format("Frame/{}", text_of(replay->steps.back().scope));
    EXPECT_FALSE(desk.widget(closed).open) << "looking for something leaves open what was open";
}

TEST(FramePanel, HasTimeMemoryAndWorkBesideEveryPassAndStep) {
    Desk& desk = timed_desk();
    must(desk.player->click("Frame/expand all"));
    const auto replay = desk.replay();
    const FrameRows rows = frame_rows(*replay, nullptr);
    const std::size_t step = some_step(*replay);
    for (const FramePass& pass : rows.passes) EXPECT_NE(desk.said(fmt::format("Frame/{} ms", text_of(pass.scope))), "");
    EXPECT_NE(desk.said(path_of(*replay, step) + " ms"), "");
    must(desk.player->choose("Frame/beside", "Memory"));
    for (const FramePass& pass : rows.passes)
        EXPECT_THAT(desk.said(fmt::format("Frame/{} alive", text_of(pass.scope))), HasSubstr("B"));
    EXPECT_THAT(desk.said(path_of(*replay, step) + " alive"), HasSubstr("B"));
    desk.expect_no_conflicts();
    must(desk.player->choose("Frame/beside", "Work"));
    for (const FramePass& pass : rows.passes) {
        EXPECT_EQ(desk.said(fmt::format("Frame/{} work", text_of(pass.scope))), plural(pass.end - pass.first, "step"));
        EXPECT_EQ(desk.said(fmt::format("Frame/{} waits", text_of(pass.scope))), fmt::format("{}", pass.barriers));
    }
    EXPECT_EQ(desk.said(path_of(*replay, step) + " work"), replay->steps[step].short_work);
    desk.expect_no_conflicts();
    must(desk.player->choose("Frame/beside", "Time"));
}

TEST(FramePanel, WhatStepsMakeIsWhatTheirStageAllocatesAndWhatIsAliveIsThePlans) {
    Desk& desk = Desk::clean();
    const auto replay = desk.replay();
    const auto session = must(Session::open(small_scenarios(), {}));
    const auto planned = must(session->plan(replay->request));
    ASSERT_EQ(replay->steps.size(), planned.plan.steps.size());
    const MemoryOverTime memory = memory_over_time(planned.plan);
    std::map<std::string, std::uint64_t> made;
    for (std::size_t i = 0; i < replay->steps.size(); ++i) {
        EXPECT_EQ(replay->steps[i].alive_bytes, memory.alive[i]);
        made[std::string(name(replay->steps[i].scope.stage))] += replay->steps[i].made_bytes;
    }
    for (const auto& [stage, bytes] : made) EXPECT_EQ(bytes, memory.stages.at(stage).allocated) << stage;
}

}  // namespace
}  // namespace strata::ui
