// Whoever waits without a terminal sees a line every ten seconds.
#include "replay/progress_line.h"

#include <atomic>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strata {
namespace {

TEST(ProgressLine, IsALineEveryTenSecondsWhereNoTerminalIs) {
    std::chrono::steady_clock::time_point now;
    testing::internal::CaptureStderr();
    const Progress show = progress_line({.clock = [&] { return now; }});
    for (int second = 1; second <= 35; ++second) {
        now += std::chrono::seconds(1);
        show_frame(show, static_cast<std::size_t>(second), 40);
    }
    show("done", 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "strata: 25 % done after 10 s, about 30 s left: frame 11 of 40\n"
              "strata: 50 % done after 20 s, about 20 s left: frame 21 of 40\n"
              "strata: 75 % done after 30 s, about 10 s left: frame 31 of 40\n");
}

TEST(ProgressLine, RepeatsTheLastReportDuringALongStep) {
    std::atomic<int> reads = 0;
    const auto clock = [&] { return std::chrono::steady_clock::time_point(std::chrono::seconds(4 * reads++)); };
    testing::internal::CaptureStderr();
    {
        const Progress show = progress_line({.clock = clock, .beat = std::chrono::milliseconds(1)});
        show("one long frame", .5);
        while (reads < 10) std::this_thread::yield();
    }
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                testing::StartsWith("strata: 50 % done after 12 s, about 12 s left: one long frame\n"
                                    "strata: 50 % done after 24 s, about 24 s left: one long frame\n"));
}

}  // namespace
}  // namespace strata
