// Whoever waits without a terminal sees a line every ten seconds.
#include "replay/progress_line.h"

#include <gtest/gtest.h>

namespace strata {
namespace {

TEST(ProgressLine, IsALineEveryTenSecondsWhereNoTerminalIs) {
    std::chrono::steady_clock::time_point now;
    testing::internal::CaptureStderr();
    const Progress show = progress_line([&] { return now; });
    for (int second = 1; second <= 35; ++second) {
        now += std::chrono::seconds(1);
        show_frame(show, static_cast<std::size_t>(second), 40);
    }
    show("done", 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "strata: 25 % done: frame 11 of 40\nstrata: 50 % done: frame 21 of 40\nstrata: 75 % done: frame 31 of 40\n");
}

}  // namespace
}  // namespace strata
