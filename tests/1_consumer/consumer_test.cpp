// A separate project, built against the installed package alone, records its own renderer; what it recorded is what it drew,
// whenever it is killed. Its sources are tests/1_capture/consumer.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <random>
#include <thread>

#include <gmock/gmock.h>

#include "capture_format/reader.h"
#include "consumer/engine.h"
#include "tests/support/file_text.h"
#include "tests/support/readme_blocks.h"

namespace strata {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path work = fs::path(STRATA_BINARY_DIR) / "consumer";
const fs::path capture_path = work / "crowd.strata";

struct Outcome {
    int code = -1;
    std::string output;
};

/// Runs a shell command; its output is both streams.
Outcome run(const std::string& command) {
    Outcome outcome;
    FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
    for (int letter; pipe && (letter = std::fgetc(pipe)) != EOF;) outcome.output += static_cast<char>(letter);
    if (pipe) outcome.code = WEXITSTATUS(::pclose(pipe));
    return outcome;
}

/// The number that follows `words` in a text, -1 without.
double number_after(const std::string& text, std::string_view words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? -1 : std::strtod(text.c_str() + at + words.size(), nullptr);
}

class Consumer : public testing::Test {
protected:
    /// Installs the package, then configures and builds the consumer as anybody would.
    static void SetUpTestSuite() {
        const std::string installed = (work / "installed").string(), built = (work / "built").string();
        fs::remove_all(work / "installed");
        for (const std::string& command :
             {fmt::format("cmake --install '{}' --component strata_capture --prefix '{}'", STRATA_BINARY_DIR, installed),
              fmt::format(
                  "cmake -S '{}/tests/1_capture/consumer' -B '{}' -G Ninja -DCMAKE_PREFIX_PATH='{}' -DCMAKE_CXX_COMPILER='{}'",
                  STRATA_SOURCE_DIR, built, installed, STRATA_CXX),
              fmt::format("cmake --build '{}'", built)}) {
            const Outcome outcome = run(command);
            ASSERT_EQ(outcome.code, 0) << command << "\n" << outcome.output;
        }
    }
    static Outcome consume(const std::string& options) {
        return run(fmt::format("'{}' --output '{}' {}", (work / "built/consumer").string(), capture_path.string(), options));
    }
};

/// That a frame says where the bodies are and were, what the paints and the screen look like, bit for bit.
void expect_frame(const Frame& frame, const consumer::Crowd& now, const consumer::Crowd& before, std::uint64_t index) {
    EXPECT_EQ(frame.index, index);
    EXPECT_EQ(frame.time, now.time);
    ASSERT_EQ(frame.draws.size(), now.bodies.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        const Draw& draw = frame.draws[i];
        wrong += draw.to_world != consumer::matrix_of(placed(now.bodies[i])) ||
                 draw.previous_to_world != consumer::matrix_of(placed(before.bodies[i])) || draw.mesh != now.bodies[i].shape ||
                 draw.material != now.bodies[i].paint;
    }
    EXPECT_EQ(wrong, 0u) << "draws of frame " << index;
    ASSERT_EQ(frame.materials.size(), consumer::paint_count);
    for (std::size_t i = 0; i < frame.materials.size(); ++i)
        EXPECT_EQ(frame.materials[i].base_color, consumer::material_of(i, now.time).base_color);
    EXPECT_EQ(frame.textures.at(0).texels, consumer::texture_of(consumer::screen_at(index)).texels);
}

/// Reads all frames there are and compares them with the same motion; how many.
std::size_t expect_frames(const Capture& capture) {
    consumer::Crowd now(2000, consumer::Motion::straight), before = now;
    for (std::size_t i = 0; i < capture.frame_count(); ++i) {
        if (i > 0) now.step(consumer::step_after(i - 1, consumer::Pace::even));
        const auto frame = capture.frame(i);
        EXPECT_TRUE(frame) << frame.error().sentence;
        if (!frame) return i;
        expect_frame(*frame, now, before, i);
        before = now;
    }
    return capture.frame_count();
}

TEST_F(Consumer, LinksNoVulkanAndNoImporter) {
    const Outcome libraries = run(fmt::format("ldd '{}'", (work / "built/consumer").string()));
    EXPECT_EQ(libraries.code, 0);
    EXPECT_THAT(libraries.output, testing::AllOf(HasSubstr("libzstd"), Not(HasSubstr("vulkan")), Not(HasSubstr("meshoptimizer")),
                                                 Not(HasSubstr("OpenEXR"))));
}

/// What CMake says of the consumer without a package; CMake breaks lines anywhere.
std::string configured_without(const std::string& package) {
    const Outcome refused = run(
        fmt::format("cmake -S '{}/tests/1_capture/consumer' -B '{}' -G Ninja -DCMAKE_PREFIX_PATH='{}' -DCMAKE_CXX_COMPILER='{}' "
                    "-DCMAKE_DISABLE_FIND_PACKAGE_{}=ON 2>&1 | tr -s ' \\n' ' '",
                    STRATA_SOURCE_DIR, (work / "incomplete").string(), (work / "installed").string(), STRATA_CXX, package));
    fs::remove_all(work / "incomplete");
    return refused.output;
}

TEST_F(Consumer, WhatTheLibraryNeedsAndIsNotInstalledIsNamedWithItsDebianPackage) {
    EXPECT_THAT(configured_without("fmt"),
                HasSubstr("strata::capture links these, which were not found: fmt. On Debian: apt install libfmt-dev"));
    EXPECT_THAT(configured_without("PkgConfig"), HasSubstr("PkgConfig. On Debian: apt install pkg-config"));
}

TEST_F(Consumer, InstalledHeadersIncludeEachOtherWhereTheyAreInstalled) {
    std::size_t headers = 0;
    for (const auto& header : fs::recursive_directory_iterator(work / "installed/include/strata")) {
        if (header.is_directory()) continue;  // frame/
        ++headers;
        EXPECT_THAT(file_text(header.path()), Not(HasSubstr("#include \""))) << header.path();
        const Outcome alone = run(fmt::format("'{}' -std=c++20 -fsyntax-only -x c++ -I '{}' '{}'", STRATA_CXX,
                                              (work / "installed/include").string(), header.path().string()));
        EXPECT_EQ(alone.code, 0) << alone.output;
    }
    EXPECT_EQ(headers, 22u);
}

/// The README's own commands, in a folder that looks like the project's after `./build.sh`.
TEST_F(Consumer, TheReadmesProgramIsBuiltAndWhatItRecordsIsReplayed) {
    const fs::path root = work / "readme";
    fs::remove_all(root);
    fs::create_directories(root);
    fs::create_directory_symlink(STRATA_BINARY_DIR, root / "build");
    fs::create_directory_symlink(fs::path(STRATA_SOURCE_DIR) / "docs", root / "docs");
    std::size_t commands = 0;
    for (const ReadmeBlock& block : blocks_of(file_text(fs::path(STRATA_SOURCE_DIR) / "README.md"))) {
        if (block.section != "Record your own renderer") continue;
        for (const ReadmeCommand& command : commands_of(block, {"cmake", "out/engine/engine", "build/strata"})) {
            ++commands;
            const Outcome outcome = run(fmt::format("cd '{}' && export CXX='{}' && {}", root.string(), STRATA_CXX, command.text));
            ASSERT_EQ(outcome.code, 0) << "README.md:" << command.line << ": " << command.text << "\n" << outcome.output;
        }
    }
    EXPECT_EQ(commands, 7u);
    const auto capture = Capture::open(root / "frames.strata");
    ASSERT_TRUE(capture) << capture.error().sentence;
    EXPECT_EQ(capture->frame_count(), 12u);
    EXPECT_TRUE(fs::exists(root / "out/frames/frames.f0011.png"));
}

TEST_F(Consumer, SixtyFramesOfTwoThousandMovingDrawsAreReadBackBitForBit) {
    const Outcome outcome = consume("--frames 60");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto capture = Capture::open(capture_path);
    ASSERT_TRUE(capture) << capture.error().sentence;
    EXPECT_EQ(expect_frames(*capture), 60u);
}

TEST_F(Consumer, ItsFileIsSmall) {
    ASSERT_EQ(consume("--frames 60").code, 0);
    EXPECT_LE(fs::file_size(capture_path), 350'000u) << "issue 3: 0.35 MB; another tool took 17";
}

TEST_F(Consumer, TheSameWithoutRecordingDrawsTheSameAndWritesNothing) {
    fs::remove(capture_path);
    const Outcome outcome = consume("--frames 3 --no-record");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.output, HasSubstr("3 frames, median"));
    EXPECT_FALSE(fs::exists(capture_path));
}

TEST_F(Consumer, MemoryStaysWithinTheBudget) {
    // 400 frames of 640 kB as fast as they can be made: a quarter of a gigabyte through 32 MiB.
    const Outcome idle = consume("--no-render --frames 400 --no-record");
    const Outcome outcome = consume("--no-render --frames 400 --budget 33554432");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_GT(number_after(outcome.output, "waited for the budget:"), 0)
        << "the budget was never reached: the test shows nothing";
    // What writing takes on top: recorder.h says twelve times the largest frame; the rest is the allocator's.
    const double growth_kib = number_after(outcome.output, "peak memory:") - number_after(idle.output, "peak memory:");
    EXPECT_LT(growth_kib, 32 * 1024 + 12 * 640 + 8 * 1024) << outcome.output;
    EXPECT_EQ(Capture::open(capture_path)->frame_count(), 400u);
}

TEST_F(Consumer, AFrameLargerThanTheBudgetIsAnErrorWithBothNumbers) {
    const Outcome outcome = consume("--frames 3 --budget 100000");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.output, testing::MatchesRegex("consumer: .*100000.*\\(record\\.budget\\)\n"));
}

/// Starts an endless consumer, kills it after a while; what it had reported as written last.
std::uint64_t killed_after(std::chrono::microseconds time, const char* drawing) {
    int pipe_ends[2];
    EXPECT_EQ(::pipe(pipe_ends), 0);
    const std::string program = (work / "built/consumer").string();
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(pipe_ends[1], STDOUT_FILENO);
        ::close(pipe_ends[0]);
        ::execl(program.c_str(), program.c_str(), "--frames", "0", "--report", "--output", capture_path.c_str(), drawing,
                nullptr);
        ::_exit(127);
    }
    ::close(pipe_ends[1]);
    std::this_thread::sleep_for(time);
    ::kill(child, SIGKILL);
    std::string reported;
    char buffer[4096];
    for (ssize_t bytes; (bytes = ::read(pipe_ends[0], buffer, sizeof(buffer))) > 0;)
        reported.append(buffer, static_cast<std::size_t>(bytes));
    ::close(pipe_ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself";
    // The last line may be half there.
    const std::size_t end = reported.rfind('\n');
    if (end == std::string::npos) return 0;
    const std::size_t begin = reported.rfind('\n', end - 1);
    return std::strtoull(reported.c_str() + (begin == std::string::npos ? 0 : begin + 1), nullptr, 10);
}

TEST_F(Consumer, KilledFiftyTimesAtRandomMomentsEveryFrameItHadReportedIsReadBack) {
    std::mt19937_64 random(1);
    std::uint64_t in_all = 0;
    // A busy machine needs more kills until enough was recorded.
    for (int kill = 0; kill < 50 || (in_all <= 50 && kill < 1000); ++kill) {
        fs::remove(capture_path);
        const auto moment = std::chrono::microseconds(random() % 300'000);
        const std::uint64_t reported = killed_after(moment, kill % 2 ? "--no-render" : nullptr);
        in_all += reported;
        const auto capture = Capture::open(capture_path, Partial::allowed);
        if (!capture && reported == 0) continue;  // killed before it had begun
        ASSERT_TRUE(capture) << capture.error().sentence;
        EXPECT_GE(capture->frame_count(), reported);
        EXPECT_EQ(expect_frames(*capture), capture->frame_count()) << "kill " << kill << " after " << moment.count() << " us";
    }
    EXPECT_GT(in_all, 50u) << "hardly anything was recorded: the test shows nothing";
}

}  // namespace
}  // namespace strata
