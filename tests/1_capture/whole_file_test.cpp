// Files that are written whole or not at all, whatever ends the process.
#include "capture_format/container/whole_file.h"

#include <csignal>

#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "capture_format/container/kept_files.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// An empty folder of the running test's own.
std::filesystem::path empty_folder() {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    const auto path = std::filesystem::path(testing::TempDir()) / ("strata_whole_file_" + test);
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
    return path;
}

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

std::string text_of(const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(WholeFile, TakesTheTargetsPlaceOnlyWhenCommitted) {
    const auto folder = empty_folder();
    ASSERT_TRUE(write_whole_file(folder / "a", "old"));
    auto file = WholeFile::begin(folder / "a");
    ASSERT_TRUE(file);
    write_file(file->temporary(), bytes_of("new"));
    EXPECT_EQ(text_of(folder / "a"), "old");
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(text_of(folder / "a"), "new");
    EXPECT_EQ(files_in(folder), 1);
}

TEST(WholeFile, GivenUpLeavesNothing) {
    const auto folder = empty_folder();
    {
        auto one = WholeFile::begin(folder / "a"), other = WholeFile::begin(folder / "a");
        ASSERT_TRUE(one && other);
        EXPECT_NE(one->temporary(), other->temporary());
        EXPECT_EQ(files_in(folder), 2);
        *one = *std::move(other);
        EXPECT_EQ(files_in(folder), 1);
    }
    EXPECT_EQ(files_in(folder), 0);
}

TEST(WholeFile, FollowsALinkAndKeepsTheMode) {
    const auto folder = empty_folder();
    ASSERT_TRUE(write_whole_file(folder / "a", "old"));
    ::chmod((folder / "a").c_str(), 0640);
    std::filesystem::create_symlink("a", folder / "link");
    ASSERT_TRUE(write_whole_file(folder / "link", "new"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(text_of(folder / "a"), "new");
    EXPECT_EQ(std::filesystem::status(folder / "a").permissions(), std::filesystem::perms(0640));
}

TEST(WholeFile, FollowsLinksToAFileThatIsNotThereYet) {
    const auto folder = empty_folder();
    std::filesystem::create_directory(folder / "below");
    std::filesystem::create_symlink("below/second", folder / "first");
    std::filesystem::create_symlink("made", folder / "below" / "second");
    ASSERT_TRUE(write_whole_file(folder / "first", "new"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "below" / "second"));
    EXPECT_EQ(text_of(folder / "below" / "made"), "new");
    std::filesystem::create_symlink("round", folder / "round");
    EXPECT_FALSE(write_whole_file(folder / "round", "new")) << "a link to itself";
}

TEST(WholeFile, SaysWhatTheSystemSaysAndIsAUsageError) {
    const auto folder = empty_folder();
    const auto expect = [](const std::filesystem::path& path, const char* words) {
        const auto written = write_whole_file(path, "text");
        ASSERT_FALSE(written) << path;
        EXPECT_EQ(written.error().fault, Fault::usage);
        EXPECT_THAT(written, FailsWith("file.cannot_write", Field("file", HasSubstr(path.string())), Field("reason", words)));
    };
    expect(folder, "Is a directory");
    expect(folder / "missing" / "a", "No such file or directory");
    expect("/dev/full", "No space left on device");
    EXPECT_EQ(files_in(folder), 0);
}

TEST(WholeFile, AKeptFileIsNotReplacedByAnyNameOrLink) {
    const auto folder = empty_folder();
    ASSERT_TRUE(write_whole_file(folder / "input", "old"));
    std::filesystem::create_symlink("input", folder / "symbolic");
    std::filesystem::create_hard_link(folder / "input", folder / "hard");
    keep_files({folder / "input"});
    for (const auto& output :
         {folder / "input", folder / "symbolic", folder / "hard", folder / ".." / folder.filename() / "input"}) {
        const auto written = write_whole_file(output, "new");
        ASSERT_FALSE(written) << output;
        EXPECT_EQ(written.error().fault, Fault::usage);
        EXPECT_THAT(written, FailsWith("file.is_input", Field("input", (folder / "input").string())));
    }
    EXPECT_TRUE(write_whole_file(folder / "other", "new"));
    keep_files({});
    EXPECT_EQ(text_of(folder / "hard"), "old");
}

TEST(WholeFile, ADeviceIsWrittenAndNotReplaced) {
    ASSERT_TRUE(write_whole_file("/dev/null", "text"));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

/// Has a file half written and then does what ends the process. Signals reach the thread that waits for them, and no other.
template <typename End>
void write_half(const std::filesystem::path& folder, End end) {
    if (!leave_nothing_half_written_when_stopped()) _exit(1);
    const auto file = WholeFile::begin(folder / "a");
    if (!file || files_in(folder) != 1) _exit(2);
    end();
    pause();
    _exit(3);
}

void signal_this_process(int signal) { ::kill(::getpid(), signal); }

TEST(WholeFileDeathTest, ASignalThatEndsTheProcessLeavesNothing) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto folder = empty_folder();
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGUSR1}) {
        EXPECT_EXIT(write_half(folder, [&] { signal_this_process(signal); }), testing::ExitedWithCode(128 + signal),
                    "no file is half written");
        EXPECT_EQ(files_in(folder), 0) << signal;
    }
}

TEST(WholeFileDeathTest, AProgramThatCannotGoOnLeavesNothing) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto folder = empty_folder();
    EXPECT_EXIT(write_half(folder, [] { end_program(4); }), testing::ExitedWithCode(4), "");
    EXPECT_EQ(files_in(folder), 0);
}

TEST(WholeFileDeathTest, TheFirstSignalAsksForAStopWhereOneIsAwaitedAndTheSecondEndsTheProcess) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto folder = empty_folder();
    const auto stop_twice = [] {
        const StopAtSignal stop;
        signal_this_process(SIGTERM);
        while (!stop.token().stop_requested()) usleep(1000);
        signal_this_process(SIGTERM);
        pause();
    };
    EXPECT_EXIT(write_half(folder, stop_twice), testing::ExitedWithCode(128 + SIGTERM), "a second signal ends it at once");
    EXPECT_EQ(files_in(folder), 0);
}

TEST(WholeFileDeathTest, ASignalThatTheCallerIgnoresIsIgnored) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto folder = empty_folder();
    const auto hang_up = [&] {
        std::signal(SIGHUP, SIG_IGN);
        write_half(folder, [] {
            signal_this_process(SIGHUP);
            _exit(0);
        });
    };
    EXPECT_EXIT(hang_up(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace strata
