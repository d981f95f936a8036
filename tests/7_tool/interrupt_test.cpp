// Ctrl-C at any moment: what is there afterwards is whole, and no temporary is.
#include <signal.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/reader.h"
#include "replay/images/image_io.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

pid_t start_strata(const std::string& arguments, const std::string& output = "/dev/null") {
    return start(STRATA_BINARY_DIR "/strata", arguments, output);
}

bool is_whole(const std::filesystem::path& file) {
    const auto kind = file.extension();
    const auto bytes = read_file(file);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (kind == ".strata") return bool(Capture::open(file));
    if (kind == ".exr") return bool(read_exr(file));
    if (kind == ".png") return text.size() > 8 && text.substr(text.size() - 8, 4) == "IEND";
    return kind == ".json" && nlohmann::json::accept(text);
}

std::string text_of(const std::string& file) {
    std::ifstream in(folder() / file);
    return {std::istreambuf_iterator<char>(in), {}};
}

void expect_only_whole_files(const std::string& command) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder()))
        EXPECT_TRUE(entry.is_directory() || is_whole(entry.path())) << command << " left " << entry.path();
}

class Interrupted : public testing::TestWithParam<const char*> {};

TEST_P(Interrupted, AtAnyMomentLeavesWholeFilesAndNoTemporary) {
    write_file(folder() / "sound.strata", sound_capture());
    ASSERT_EQ(code_of(start_strata(GetParam())), 0);  // compiles what later runs find in the driver's cache
    const auto began = std::chrono::steady_clock::now();
    ASSERT_EQ(code_of(start_strata(GetParam())), 0);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - began;
    std::mt19937 random(3);
    int interrupted = 0;
    for (int i = 0; i < 6; ++i) {
        const pid_t process = start_strata(GetParam());
        std::this_thread::sleep_for(std::uniform_real_distribution<>(0, 1)(random) * whole);
        kill(process, i % 2 == 1 ? SIGTERM : SIGINT);
        const int code = code_of(process);
        EXPECT_THAT(code, testing::AnyOf(0, 130, i % 2 == 1 ? 143 : 130));  // a report that prints what there is ends with 130
        interrupted += code != 0;
        expect_only_whole_files(GetParam());
    }
    EXPECT_GT(interrupted, 1);
}

INSTANTIATE_TEST_SUITE_P(Verbs, Interrupted,
                         testing::Values("record three_panes --frames 150 -o made.strata", "replay sound.strata -o out",
                                         "report sound.strata --repeats 1 --sweep pool=2 --json -o report.json"));

/// The first signal asks for what there is.
TEST(Interrupt, OfAReportPrintsWhatWasMeasured) {
    write_file(folder() / "sound.strata", sound_capture());
    for (const int signal : {SIGINT, SIGTERM}) {
        const pid_t process = start_strata("report sound.strata --repeats 20 -o report.txt", "progress.txt");
        for (int waits = 0; waits < 600 && text_of("progress.txt").find("8 of ") == std::string::npos; ++waits)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        kill(process, signal);
        EXPECT_EQ(code_of(process), 130);
        const std::string report = text_of("report.txt");
        EXPECT_THAT(report, testing::ContainsRegex("\nstopped after [0-9]+ of [0-9]+ (rows|timed runs)\n"));
        EXPECT_THAT(report, testing::HasSubstr("sorted_lists"));
        std::filesystem::remove(folder() / "report.txt");
        std::filesystem::remove(folder() / "progress.txt");
    }
}

/// What the command prints that is interrupted after this time.
std::string printed_until(double seconds, const std::string& arguments) {
    const pid_t process = start_strata(arguments, "printed.txt");
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(process, SIGINT);
    EXPECT_EQ(code_of(process), 130) << text_of("printed.txt");
    return text_of("printed.txt");
}

/// The least time in which one ratio is measured is not known.
TEST(ExhaustiveInterrupt, OfABenchPrintsTheRatiosThatAreComplete) {
    for (double seconds = 2; seconds < 60; seconds *= 2) {
        const std::string printed = printed_until(seconds, "bench voxel --size 32x18 --repeats 100");
        if (HasFailure()) return;
        if (printed.find("measured") == std::string::npos) continue;
        EXPECT_THAT(printed, testing::ContainsRegex("\nstopped after [0-9]+ of [0-9]+ ratios\n"));
        return;
    }
    FAIL() << "no ratio in a minute";
}

/// As above; the device's own limits are measured first.
TEST(ExhaustiveInterrupt, OfADeviceBenchPrintsTheStepsByTheRunsThatAreComplete) {
    for (double seconds = 2; seconds < 100; seconds *= 1.5) {
        const std::string printed = printed_until(seconds, "bench device --repeats 40");
        if (HasFailure()) return;
        if (printed.find("GB/s") == std::string::npos) continue;
        EXPECT_THAT(printed, testing::ContainsRegex("\nstopped after [0-9]+ of 40 timed runs\n"));
        return;
    }
    FAIL() << "no timed run in 100 seconds";
}

/// A thousand repeats of every row last longer than any time tried here; the least time in which a row is measured is not known.
TEST(Interrupt, ByTheMinutesThatAReportMayTakeIsNoFailure) {
    write_file(folder() / "sound.strata", sound_capture());
    for (double minutes = .02; minutes < 10; minutes *= 2) {
        const Finished report = strata(fmt::format("-v report sound.strata --repeats 1000 --minutes {}", minutes));
        if (report.code == 2) {
            EXPECT_THAT(report, Refuses(2, "report.no_row_in_time", fmt::format("minutes={}", minutes)));
            continue;
        }
        EXPECT_EQ(report.code, 0);
        EXPECT_THAT(report.out, testing::HasSubstr("sorted_lists"));
        EXPECT_THAT(report.out, testing::HasSubstr("\nstopped after "));
        EXPECT_THAT(report.err, testing::HasSubstr(fmt::format("{} minutes are over: stopped after ", minutes)));
        return;
    }
    FAIL() << "no row in 10 minutes";
}

/// What was there before is whole and old, or whole and new.
TEST(Interrupt, OfARecordingLeavesTheOldCapture) {
    const auto old = sound_capture();
    write_file(folder() / "made.strata", old);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const pid_t process = start_strata("record three_panes --frames 100000 -o made.strata");
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        kill(process, signal);
        EXPECT_EQ(code_of(process), 128 + signal);
        EXPECT_EQ(read_file(folder() / "made.strata"), old);
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder()), std::filesystem::directory_iterator()), 1);
}

}  // namespace
}  // namespace strata
