// A memory budget is kept to, by the device's own count of what was allocated, or refused with numbers before anything is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t mib = 1 << 20;

std::unique_ptr<Session> session_within(std::uint64_t budget, std::uint32_t frames = 1) {
    return must(Session::open(scenario_frames("glass_and_smoke", 4, frames), {.validation = true, .memory_budget = budget}));
}

/// What the frames take at most, of a session that may take what it likes but shares no blocks.
std::uint64_t peak_of(const Run& run) { return run.memory.peak_allocated; }

TEST(MemoryBudget, IsKeptToWhileThePictureStaysTheSame) {
    const auto generous = session_within(1024 * mib);
    const auto free = must(generous->run({}));
    ASSERT_GT(free.memory.memo, 0u);
    const std::uint64_t tight = peak_of(free) - free.memory.memo / 2;  // less than it would like to keep
    const auto bounded = session_within(tight);
    const auto run = must(bounded->run({}));
    EXPECT_LE(peak_of(run), tight);
    EXPECT_LT(run.memory.memo, free.memory.memo);
    EXPECT_EQ(hash_of(run.images.at("display")), hash_of(free.images.at("display")));
    const auto again = must(bounded->run({}));
    EXPECT_LE(peak_of(again), tight);
    EXPECT_EQ(hash_of(again.images.at("display")), hash_of(free.images.at("display")));
}

TEST(MemoryBudget, HoldsOverFramesPassesJudgmentsAndTimings) {
    const auto generous = session_within(1024 * mib);
    Request everything{.passes = Passes::read_back};
    const std::uint64_t budget = peak_of(must(generous->run(everything))) + 2 * mib;  // small things are reckoned with 1 MiB
    const auto bounded = session_within(budget, 2);
    for (const std::size_t frame : {0u, 1u, 0u}) {
        everything.variant.frame = frame;
        must(bounded->run({.variant = {.frame = frame}}));
        must(bounded->run(everything));
    }
    must(bounded->judge({.variant = {.extent_divisor = 4, .samples = 1}}, Stage::transparency, Against::truth));
    const std::vector<Request> timed(2);
    EXPECT_LE(peak_of(must(bounded->time(timed, 2)).back()), budget);
}

TEST(MemoryBudget, WhatDoesNotFitIsRefusedWithNumbersAndNothingIsAllocated) {
    const auto session = session_within(16 * mib);
    const auto refused = session->run({});
    ASSERT_THAT(refused,
                FailsWith("session.memory_budget", Field("budget_mebibytes", 16), Field("shares", HasSubstr("largest are '"))));
    EXPECT_EQ(refused.error().fault, Fault::device_lacks);
    EXPECT_FALSE(session->run({.passes = Passes::read_back}));
    // What fits afterwards shows how much there ever was.
    const auto small = must(session->run({.variant = {.extent_divisor = 16, .samples = 1}}));
    EXPECT_LE(peak_of(small), 16 * mib);
}

TEST(MemoryMetrics, SayWhatEachStageAllocatesAndWhichStepHoldsTheMost) {
    const auto run = must(scenario_session("three_panes")->run({}));
    const MemoryOverTime& over_time = run.memory.over_time;
    std::uint64_t sum = 0;
    for (const auto& [stage, memory] : over_time.stages) {
        sum += memory.allocated;
        EXPECT_LE(memory.peak, over_time.peak) << stage;
    }
    EXPECT_GE(sum, run.image_bytes + run.buffer_bytes);  // images that share memory count each
    EXPECT_LE(over_time.peak, run.image_bytes + run.buffer_bytes);
    EXPECT_FALSE(over_time.fullest_step.empty());
    EXPECT_GE(run.memory.plan, over_time.peak);
    EXPECT_GE(run.memory.allocated, run.memory.plan + run.memory.scene + run.memory.memo);
    EXPECT_GT(run.memory.host_peak, run.memory.plan);
}

}  // namespace
}  // namespace strata
