// How often shaders run, counted by a part of the frame: as a whole run counts it.
#include "replay/session/step_counts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "replay/session/device_session.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Request on(const std::string& scenario, const std::string& technique) {
    Request request = on_scenario(scenario);
    request.choices = chosen({technique});
    return request;
}

TEST(StepCounts, OfIndirectDispatchesAreWhatAWholeRunCounts) {
    Session& session = session_of_scenarios();
    const Request request = on("agents_hq", "lighting/tiled");
    const StepCounts counts = must(count_steps(session, request));
    const auto whole = must(static_cast<DeviceSession&>(session).time_alone(request));
    const Plan plan = must(session.plan(request)).plan;
    ASSERT_EQ(counts.invocations.size(), plan.steps.size());
    std::size_t compared = 0;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const auto* compute = std::get_if<ComputeWork>(&plan.steps[i].step.work);
        if (!compute || !compute->arguments) continue;
        EXPECT_EQ(counts.invocations[i], whole.step_costs[i].invocations) << plan.steps[i].step.name;
        compared += *counts.invocations[i] > 0;
    }
    EXPECT_GE(compared, 4u);
}

TEST(StepCounts, OfATechniqueThatDrawsOnceAreItsOwn) {
    Session& session = session_of_scenarios();
    const Request request = on("three_panes", "transparency/weighted");
    const StepCounts counts = must(count_steps(session, request));
    const auto fragments = [](const std::vector<CounterRecord>& counters) {
        const auto found = std::ranges::find(counters, fragments_counter, &CounterRecord::name);
        return found == counters.end() ? 0 : found->value;
    };
    EXPECT_GT(fragments(counts.counters), 100u);
    EXPECT_EQ(fragments(counts.counters), fragments(must(session.run(request)).counters));
}

/// Fragments of every step that draws what is transparent, by the rasterizer in double.
std::vector<std::uint64_t> rasterized(Session& session, const Request& request) {
    std::vector<std::uint64_t> all;
    for (const auto& count : must(count_steps(session, request)).rasterized)
        if (count) all.push_back(*count);
    return all;
}

// The counter of sorted lists is an atomic of the device. Panes cover every fragment of theirs, smoke does not: the corners of
// its particles run shaders, too, and are counted by none.
TEST(StepCounts, OfEveryDrawOfWhatIsTransparentAreTheRasterizersWhereADeviceCannotCount) {
    Session& session = session_of_scenarios();
    if (!session.device().software) GTEST_SKIP() << "this device counts fragments";
    const auto counter = [&](const std::string& scenario) {
        return counted(must(session.run(on(scenario, "transparency/sorted_lists"))), "fragments");
    };
    const std::pair<const char*, std::size_t> steps[] = {{"alpha_blend", 1}, {"weighted", 1}, {"sorted_lists", 2},
                                                         {"stochastic", 2},  {"moments", 2},  {"exact_function", 3}};
    const std::uint64_t of_panes = counter("three_panes"), of_smoke = counter("smoke_grenade");
    for (const auto& [technique, count] : steps) {
        const std::string name = std::string("transparency/") + technique;
        EXPECT_EQ(rasterized(session, on("three_panes", name)), std::vector(count, of_panes)) << name;
        const auto smoke = rasterized(session, on("smoke_grenade", name));
        EXPECT_EQ(smoke.size(), count) << name;
        for (const std::uint64_t fragments : smoke) {
            EXPECT_GT(fragments, of_smoke + of_smoke / 20) << name;
            EXPECT_LT(fragments, 2 * of_smoke) << name;
        }
    }
    EXPECT_TRUE(rasterized(session, on("three_panes", "transparency/depth_peeling")).empty()) << "tested against its own depth";
}

TEST(StepCounts, AreKnownWithoutTheShadersThatTheyAreOf) {
    // On a device of its own, which has no pipelines of other tests.
    const auto session = must(Session::open(scenario_frames("agents_hq"), {.validation = true}));
    Request request{.choices = chosen({"lighting/tiled"})};
    must(count_steps(*session, request));
    request.until = "lighting/tiled/shade.comp";
    const auto run = must(session->run(request));
    const auto shades = std::ranges::count(run.steps, request.until, &StepRecord::name);
    EXPECT_GE(shades, 4);
    EXPECT_GE(run.pipelines_created, static_cast<std::size_t>(shades)) << "they were not there before";
}

}  // namespace
}  // namespace strata
