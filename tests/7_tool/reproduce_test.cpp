// The "reproduce:" lines of failed tests are commands: each runs as it is printed.
#include <sys/wait.h>

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/registry.h"
#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"
#include "tests/support/shell_lines.h"

namespace strata {
namespace {

Finished run_in_folder(const std::string& line) {
    const std::string command = fmt::format("cd '{}' && {{ {} ; }} >stdout.txt 2>stderr.txt", folder().string(), line);
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), file_text(folder() / "stdout.txt"), file_text(folder() / "stderr.txt")};
}

struct Judged {
    std::string scenario;
    std::uint32_t samples;
    std::vector<std::string> uses, sets;
    std::string row;  ///< of the report: the technique and its settings
};

/// Every kind of setting: none, a choice, an integer, a float, several, one that two stages have, and those of other stages.
TEST(Reproduce, MeasuresWhatTheTestJudgedAtAllKindsOfSettings) {
    const Judged all[] = {
        {"three_panes", 1, {"transparency/weighted"}, {}, "weighted"},
        {"three_panes", 4, {"transparency/k_buffer"}, {"layers=4", "tail=drop"}, "k_buffer layers=4 tail=drop"},
        {"three_panes",
         1,
         {"transparency/weighted"},
         {"transparency/weighted:scale=2.5", "weight=w9"},
         "weighted scale=2.5 weight=w9"},
        {"hall_of_lights_64", 1, {"lighting/tiled", "gbuffer/packed"}, {"force=3", "half_z=off"}, "tiled force=3 half_z=off"},
        {"opaque_only",
         1,
         {"combine/hi_lo"},
         {"fog=linear", "fog_near=0.25", "fog_far=1e1"},
         "hi_lo fog=linear fog_near=0.25 fog_far=1e1"},
        {"corners", 1, {"occlusion/ssao"}, {"ao_radius=1m", "combine/hi_lo:resolve=lo_hi"}, "ssao ao_radius=1m"},
    };
    for (const Judged& one : all) {
        Request request = on_scenario(one.scenario, one.samples);
        request.choices = chosen(one.uses, one.sets);
        const std::string line = line_that_judges(*must(find_technique(one.uses.front())), request, one.scenario);
        const Finished run = run_in_folder(line);
        EXPECT_EQ(run.code, 0) << line << "\n" << run.err;
        EXPECT_THAT(run.out, testing::HasSubstr(one.row)) << line;
    }
}

TEST(Reproduce, ReplaysAGoldenFrame) {
    const std::string line = line_that_replays("three_cards", on_scenario("three_cards", 1).variant);
    const Finished run = run_in_folder(line);
    EXPECT_EQ(run.code, 0) << line << "\n" << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder() / "out")) << line;
}

}  // namespace
}  // namespace strata
