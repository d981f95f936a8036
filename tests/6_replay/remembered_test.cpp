// What frames leave to the next (Graph::remember): nothing in a session's first run, then what the last run left; who looks at it
// is executed every time.
#include <algorithm>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// A technique that remembers the thickness of its slices, which fewer of them make larger.
Request with_slices(const std::string& count, const std::string& frames = "100") {
    return {.choices = chosen({"transparency/voxel"}, {"slices=" + count, "curve=linear", "hysteresis=" + frames})};
}

std::uint64_t held(Session& session, const Request& request) { return counted(must(session.run(request)), "halvings held"); }

TEST(Remembered, IsZeroAtFirstAndThenWhatTheLastRunLeft) {
    const auto session = scenario_session("glass_and_smoke");
    EXPECT_EQ(held(*session, with_slices("256")), 0u);
    EXPECT_EQ(held(*session, with_slices("32")), 0u);
    EXPECT_GT(held(*session, with_slices("256")), 0u);
    const auto another = scenario_session("glass_and_smoke");
    EXPECT_EQ(held(*another, with_slices("256")), 0u);
}

TEST(Remembered, IsForgottenWithTheMemo) {
    const auto session = scenario_session("glass_and_smoke");
    const auto first = must(session->run(with_slices("256")));
    must(session->run(with_slices("32")));
    EXPECT_GT(held(*session, with_slices("256")), 0u);
    session->forget_memo();
    const auto again = must(session->run(with_slices("256")));
    EXPECT_EQ(hash_of(again.images.at("display")), hash_of(first.images.at("display")));
}

TEST(Remembered, IsLookedAtInEveryRun) {
    const auto session = scenario_session("glass_and_smoke");
    const auto executes_transparency = [&](const Request& request) {
        const auto run = must(session->run(request));
        return std::ranges::any_of(
            run.steps, [](const StepRecord& s) { return s.scope.kind == ScopeKind::pass && s.scope.at == Stage::transparency; });
    };
    EXPECT_TRUE(executes_transparency(with_slices("64")));
    EXPECT_TRUE(executes_transparency(with_slices("64")));
    EXPECT_TRUE(executes_transparency(with_slices("64", "0")));
    EXPECT_FALSE(executes_transparency(with_slices("64", "0")));  // who does not is taken from the memo
}

/// Light volumes, which keep their light.
Request lit_room() {
    Request request{.choices = chosen({"indirect/lpv"}, {"map_size=16", "iterations=2"})};
    request.outputs = {"indirect"};
    return request;
}

std::uint64_t injected(const strata::Run& run) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == "indirect/lpv" && counter.name == "injected") return counter.value;
    ADD_FAILURE() << "not counted";
    return 0;
}

TEST(RememberedWork, IsNotDoneAgainAndIsDoneAgainWhereItIsTimed) {
    const auto session = scenario_session("two_rooms");
    Request request = lit_room(), unchanged = lit_room();
    request.once = unchanged.once = unchanged.unchanged = true;
    const std::uint64_t all = injected(must(session->run(request)));
    EXPECT_GT(all, 0u);
    EXPECT_EQ(injected(must(session->run(request))), 0u);
    const std::vector<Request> requests{request, unchanged, request};
    const auto runs = must(session->time(requests, 2));
    EXPECT_EQ(injected(runs[0]), all);
    EXPECT_EQ(injected(runs[1]), 0u);
    EXPECT_EQ(injected(runs[2]), all);
    EXPECT_EQ(injected(must(session->time(std::span(requests).first(1), 1)).front()), all);
}

TEST(RememberedWork, IsDoneAgainWhereStepsAreLookedAt) {
    const auto session = scenario_session("two_rooms");
    Request request = lit_room();
    request.once = true;
    const auto hashes = [&] {
        std::vector<std::string> all;
        for (const StepImages& step : must(session->step_images(request, Stage::indirect)))
            for (const auto& [name, image] : step.images) all.push_back(hash_of(image));
        return all;
    };
    const auto before = hashes();
    must(session->run(request));
    EXPECT_EQ(hashes(), before);
    const Session::PlannedFrame planned = must(session->plan(request));
    for (std::size_t i = 0; i < planned.plan.steps.size(); ++i) {
        if (!planned.plan.steps[i].step.name.ends_with("injection/map")) continue;
        must(session->run(request));
        const HostImage map = must(session->peek(request, i, "lit positions"));
        EXPECT_NE(map.texels, std::vector<std::byte>(map.texels.size())) << "step " << i;
        break;
    }
}

TEST(RememberedWork, IsNotTakenForTheHistoryOfAnotherSetting) {
    const auto session = scenario_session("two_rooms");
    const auto with = [](const char* text) {
        Request request = lit_room();
        set(request, text);
        request.once = true;
        return request;
    };
    const Request halves = with("cell_storage=half");
    const std::string wanted = hash_of(must(session->run(halves)).images.at("indirect"));
    session->forget_memo();
    must(session->run(with("slice=1")));
    must(session->run(halves));
    const auto timed = must(session->time(std::span(&halves, 1), 1));
    EXPECT_GT(injected(timed.front()), 0u);
    EXPECT_EQ(hash_of(must(session->run(halves)).images.at("indirect")), wanted);
}

TEST(RememberedWork, IsNotDoneWhereNothingReadsIt) {
    const auto session = scenario_session("two_rooms");
    Request request = lit_room();
    request.once = true;
    request.outputs = {"depth_layers"};
    const auto run = must(session->run(request));
    for (const StepRecord& step : run.steps) EXPECT_FALSE(step.name.starts_with("indirect/")) << step.name;
    EXPECT_GT(injected(must(session->run(lit_room()))), 0u);
}

TEST(RememberedWork, IsNoReasonToExecuteAPassTwice) {
    const auto session = scenario_session("two_rooms");
    must(session->run(lit_room()));
    EXPECT_EQ(must(session->run(lit_room())).passes_executed, 0u);
    Request sliced = lit_room();
    set(sliced, "slice=1");
    must(session->run(sliced));
    EXPECT_GT(must(session->run(sliced)).passes_executed, 0u) << "it shows what it remembers";
}

}  // namespace
}  // namespace strata
