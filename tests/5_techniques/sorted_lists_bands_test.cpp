// The memory of transparency/sorted_lists: however small the pool, no fragment is dropped and no bit of the image changes.
#include <algorithm>

#include <gtest/gtest.h>

#include "passes/reference/fragments.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Run run_with_pool(Session& session, std::string_view pool) {
    Request request;
    request.choices = chosen({"transparency/sorted_lists"}, {fmt::format("pool={}", pool)});
    request.outputs = {"color", "depth_layers"};
    return must(session.run(request));
}

std::size_t steps_called(const Run& run, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::count(run.steps, name, &StepRecord::name));
}

TEST(SortedListsMemory, IsSharedByBandsOfRowsThatGiveTheSameBits) {
    const auto session = scenario_session("glass_and_smoke", 4);
    const auto whole = run_with_pool(*session, "64"), banded = run_with_pool(*session, "0.01");
    EXPECT_EQ(steps_called(whole, "transparency/lists/sort.comp"), 1u);
    EXPECT_GT(steps_called(banded, "transparency/lists/sort.comp"), 3u);
    EXPECT_EQ(whole.images.at("color").texels, banded.images.at("color").texels);
    for (const std::string_view counter : {"fragments", "deepest", "dropped"})
        EXPECT_EQ(counted(whole, counter), counted(banded, counter)) << counter;
}

TEST(SortedListsMemory, HoldsEveryFragmentTheReferenceFinds) {
    const auto session = scenario_session("smoke_grenade");
    const auto run = run_with_pool(*session, "2");
    const FragmentLists lists = transparent_fragments(must(session->frame(0)), in_double(run.images.at("depth_layers")));
    EXPECT_EQ(counted(run, "dropped"), 0u);
    // Coverage at the edges and alphas around 1e-5 hang on rounding.
    EXPECT_NEAR(double(counted(run, "fragments")), double(lists.total()), 1e-3 * double(lists.total()));
    EXPECT_NEAR(double(counted(run, "deepest")), double(lists.deepest()), 2);
}

}  // namespace
}  // namespace strata
