// When memory ends.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using testing::HasSubstr;

TEST(Memory, ThatDoesNotSufficeIsASentence) {
    write_file(folder() / "vast.strata", vast_capture());
    const Finished failed = strata_after("ulimit -v 400000", "info vast.strata");
    EXPECT_EQ(failed.code, 4) << failed.err;
    EXPECT_THAT(failed.err, HasSubstr("memory"));
}

// From where the driver cannot start to where the frame is replayed. A driver may crash without memory; strata may not.
TEST(Memory, ThatDoesNotSufficeForADeviceIsNoCrashOfOurs) {
    write_file(folder() / "sound.strata", sound_capture());
    for (const char* limit : {"300000", "340000", "400000"}) {
        const Finished failed = strata_after(fmt::format("ulimit -c 0 && ulimit -v {}", limit), "replay sound.strata --frames 0");
        EXPECT_THAT(failed.err, Not(HasSubstr("terminate called"))) << limit;
        EXPECT_NE(failed.code, 5) << limit << failed.err;
        if (failed.code == 4) {
            EXPECT_THAT(failed.err, HasSubstr("memory")) << limit;
        }
    }
}

}  // namespace
}  // namespace strata
