// The chart of a plan says what the plan says.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/stages.h"
#include "replay/plural.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/plan/plan_chart.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

const Session::PlannedFrame& planned() {
    static const Session::PlannedFrame frame = must(session_of_scenarios().plan(on_scenario("glass_and_smoke")));
    return frame;
}

TEST(PlanPicture, HasEveryStepEveryBarrierAndEveryUse) {
    const Plan& plan = planned().plan;
    const PlanPicture picture = picture_of(planned());
    ASSERT_EQ(picture.steps.size(), plan.steps.size());
    std::size_t barriers = plan.final_barriers.size();
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        barriers += plan.steps[i].barriers.size();
        EXPECT_EQ(picture.steps[i].barriers.size(), plan.steps[i].barriers.size());
        for (const Use& use : uses(plan.steps[i])) {
            const std::string& name = use.image ? plan.images[use.image.id].name : plan.buffers[use.buffer.id].name;
            const auto shows_use = [&](const PlanResource& resource) {
                const PlanTouch* touch = resource.touch(i);
                return resource.name == name && resource.is_image == bool(use.image) && touch &&
                       (touch->writes || !writes(use.access)) && (touch->reads || !reads(use.access));
            };
            EXPECT_TRUE(std::ranges::any_of(picture.resources, shows_use)) << i << " " << name;
        }
    }
    EXPECT_EQ(picture.barriers(), barriers);
    EXPECT_GT(barriers, 10u);
}

TEST(PlanPicture, NobodyHasMemoryThatAnotherStillHas) {
    const PlanPicture picture = picture_of(planned());
    std::uint64_t bytes = 0;
    std::size_t shared = 0;
    for (const PlanMemory& memory : picture.memory) {
        bytes += memory.bytes;
        shared += memory.resources.size() - 1;
        for (std::size_t i = 1; i < memory.resources.size(); ++i)
            EXPECT_LT(picture.resources[memory.resources[i - 1]].last, picture.resources[memory.resources[i]].first());
    }
    EXPECT_EQ(bytes, picture.image_bytes + picture.buffer_bytes);
    EXPECT_GT(shared, 0u);
    EXPECT_GT(picture.unshared_bytes, picture.image_bytes);
}

TEST(PlanPicture, WhatIsAliveAtAStepIsTheSumOfWhatLivesThen) {
    const PlanPicture picture = picture_of(planned());
    for (std::size_t i = 0; i < picture.steps.size(); ++i) {
        std::uint64_t alive = 0;
        for (const PlanResource& resource : picture.resources)
            if (!resource.is_imported && resource.first() <= i && i <= resource.last) alive += resource.bytes;
        EXPECT_EQ(picture.over_time.alive[i], alive) << i;
    }
    EXPECT_EQ(picture.over_time.peak, std::ranges::max(picture.over_time.alive));
}

TEST(PlanChart, AColumnIsFoundWhereItIsDrawnAndStaysUnderThePointerThatZooms) {
    const ChartSize size{.columns = 40, .rows = 60, .names = 104};
    const ImVec2 from(100, 50), extent(700, 400);
    ChartView view;
    PlanChart chart = place(view, from, extent, size);
    const auto middle = [&](std::size_t step) { return chart.x_of(double(step) + .5); };
    for (std::size_t step = 0; step < 40; ++step) EXPECT_EQ(chart.step_at({middle(step), 60}), step);
    EXPECT_EQ(chart.step_at({from.x + 5, 300}), std::nullopt);  // a row's name
    EXPECT_EQ(chart.row_at({from.x + 5, chart.y_of(3) + 5}), 3u);
    const ImVec2 pointer(middle(20), 300);
    for (int i = 0; i < 5; ++i) {
        view = moved(view, chart, {.at = pointer, .wheel = 1});
        chart = place(view, from, extent, size);
        EXPECT_EQ(chart.step_at(pointer), 20u) << view.zoom;
    }
    EXPECT_GT(chart.column, 30);
    view = shown(view, chart, 39);
    chart = place(view, from, extent, size);
    EXPECT_EQ(chart.step_at({middle(39), 60}), 39u);
}

TEST(PlanPanel, SaysWhatASelectedStepWaitsForAndTouches) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("glass_and_smoke"));
    must(desk.player->click("tabs/Plan"));
    must(desk.player->wait());
    const auto replay = desk.replay();
    EXPECT_THAT(desk.said("Plan/counts"), HasSubstr(plural(replay->steps.size(), "step")));
    const auto busiest = std::ranges::max_element(replay->steps, {}, &PlanRow::barriers);
    const auto index = static_cast<std::size_t>(busiest - replay->steps.begin());
    desk.model().step = index;
    must(desk.player->wait());
    EXPECT_EQ(desk.said("Plan/step/name"), fmt::format("{} {}", index, busiest->name));
    EXPECT_THAT(desk.said(fmt::format("Plan/step/barrier {}", busiest->barriers - 1)), HasSubstr(" -> "));
    desk.expect_no_conflicts();
}

TEST(PlanPanel, AClickOnAColumnSelectsTheStepAndWhatItWrites) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Plan"));
    must(desk.player->wait());
    const auto& steps = desk.replay()->steps;
    const auto wanted = std::ranges::find_if(steps, [](const PlanRow& row) { return !row.images.empty(); });
    ASSERT_NE(wanted, steps.end());
    const WidgetRecord canvas = desk.widget("Plan/chart");
    const ImVec2 size(canvas.to.x - canvas.from.x, canvas.to.y - canvas.from.y);
    std::vector<PlanStep> named;
    for (const PlanRow& row : steps) named.push_back({.name = row.name});
    const ChartSize cells{.columns = steps.size(), .rows = 1, .names = names_height(named)};
    const PlanChart chart = place({}, canvas.from, size, cells);
    const double column = double(wanted - steps.begin()) + .5;
    must(desk.player->move("Plan/chart", (chart.x_of(column) - canvas.from.x) / size.x, .05f));
    must(desk.player->pull(0, 0));
    EXPECT_EQ(desk.model().step, static_cast<std::size_t>(wanted - steps.begin()));
    EXPECT_THAT(wanted->images, testing::Contains(desk.model().image.name));
}

TEST(PlanPanel, TheHeaderIsAsHighAsTheLongestNameAndNoHigherThanALimit) {
    Desk::clean();
    const float one = names_height({{.name = "lighting/z_binned/shade.comp"}});
    const float two = names_height({{.name = "shade.comp"}, {.name = "clear shadow_maps"}});
    EXPECT_LT(one, two) << "a step is named by the end of its name";
    const float most = names_height({{.name = std::string(60, 'm')}});
    EXPECT_LT(two, most);
    EXPECT_EQ(most, names_height({{.name = std::string(90, 'm')}}));
}

TEST(PlanPanel, ItsSummaryIsNotCutOff) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Plan"));
    must(desk.player->wait());
    const float edge = desk.widget("Plan/chart").to.x;
    EXPECT_LE(desk.widget("Plan/bytes").to.x, edge);
    EXPECT_LE(desk.widget("Plan/counts").to.x, edge);
}

TEST(PlanPanel, SaysWhyStagesWereLeftOutAndHowMuchEachHolds) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Plan"));
    must(desk.player->choose("Plan/show", "Left out"));
    must(desk.player->wait());
    ASSERT_FALSE(desk.replay()->skipped.empty());
    for (const SkippedStage& skipped : desk.replay()->skipped)
        EXPECT_EQ(desk.said(fmt::format("Plan/left out/{}", name(skipped.stage))), skipped.reason);
    must(desk.player->choose("Plan/show", "Memory"));
    must(desk.player->wait());
    EXPECT_THAT(desk.said(fmt::format("Plan/{}/peak", name(desk.replay()->steps.front().scope.stage))), HasSubstr("B"));
    desk.expect_no_conflicts();
    must(desk.player->choose("Plan/show", "Steps and images"));
}

}  // namespace
}  // namespace strata::ui
