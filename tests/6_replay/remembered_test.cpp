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

}  // namespace
}  // namespace strata
