// Expectations go into a finished capture all at once or not at all, and are no part of what the capture is.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

#include <gmock/gmock.h>

#include "capture_format/expectation_writer.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

void record(const std::filesystem::path& path) {
    auto recorder = Recorder::create(path);
    ASSERT_TRUE(recorder);
    ASSERT_TRUE(recorder->record(triangle_frame()));
    ASSERT_TRUE(recorder->finish());
}

std::vector<std::byte> texels(std::size_t count, int salt) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 31 + i / 251 * static_cast<std::size_t>(salt));
    return bytes;
}

TEST(ExpectationWriter, KeepsTextsAndImagesAndTheCapturesId) {
    const TemporaryFile file;
    record(file.path());
    const std::string id = Capture::open(file.path())->id();
    const auto red = texels(5000, 1), blue = texels(70000, 2);
    auto writer = ExpectationWriter::extend(file.path());
    ASSERT_TRUE(writer);
    const std::string red_name = writer->add_image(red), blue_name = writer->add_image(blue);
    ASSERT_TRUE(writer->add("first"));
    EXPECT_EQ(writer->add_image(red), red_name);
    ASSERT_TRUE(writer->add("second"));
    ASSERT_TRUE(writer->finish());

    const auto capture = Capture::open(file.path());
    ASSERT_TRUE(capture);
    EXPECT_EQ(capture->id(), id);
    EXPECT_EQ(capture->expectations(), (std::vector<std::string>{"first", "second"}));
    EXPECT_EQ(*capture->expected_image(red_name, red.size()), red);
    EXPECT_EQ(*capture->expected_image(blue_name, blue.size()), blue);
    EXPECT_TRUE(capture->frame(0));
}

TEST(ExpectationWriter, AnImageThatIsNotThereIsBadInput) {
    const TemporaryFile file;
    record(file.path());
    auto writer = ExpectationWriter::extend(file.path());
    ASSERT_TRUE(writer);
    const std::string name = writer->add_image(texels(100, 1));
    ASSERT_TRUE(writer->add("text") && writer->finish());
    const auto capture = Capture::open(file.path());
    for (const auto& [wrong, size] : {std::pair<std::string, std::uint64_t>{"no hash", 100},
                                      {std::string(32, 'z'), 100},
                                      {std::string(32, '0'), 100},
                                      {name, 101}}) {
        const auto found = capture->expected_image(wrong, size);
        ASSERT_FALSE(found) << wrong;
        EXPECT_EQ(found.error().fault, Fault::bad_input);
    }
}

TEST(ExpectationWriter, WithoutFinishTheCaptureIsAsItWas) {
    const TemporaryFile file;
    record(file.path());
    const std::vector<std::byte> before = read_file(file.path());
    {
        auto writer = ExpectationWriter::extend(file.path());
        ASSERT_TRUE(writer && writer->add("never finished"));
    }
    EXPECT_EQ(read_file(file.path()), before);
}

TEST(ExpectationWriter, AKilledProcessLeavesTheCaptureAsItWas) {
    const TemporaryFile file;
    record(file.path());
    const std::vector<std::byte> before = read_file(file.path());
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto writer = ExpectationWriter::extend(file.path());
        if (!writer || !writer->add(std::string(100000, 'x'))) _exit(1);
        raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(read_file(file.path()), before);
    EXPECT_TRUE(Capture::open(file.path()));
}

TEST(ExpectationWriter, ProcessesThatWriteAtOnceLoseNothing) {
    const TemporaryFile file;
    record(file.path());
    constexpr int processes = 4, texts = 10;
    for (int process = 0; process < processes; ++process)
        if (fork() == 0) {
            bool written = true;
            for (int i = 0; i < texts; ++i)
                written = written && append_expectation(file.path(), fmt::format("{} of {}", i, process));
            _exit(written ? 0 : 1);
        }
    for (int process = 0; process < processes; ++process) {
        int status = 0;
        wait(&status);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    const auto expectations = Capture::open(file.path())->expectations();
    const std::set<std::string> different(expectations.begin(), expectations.end());
    EXPECT_EQ(different.size(), std::size_t{processes} * texts);
}

TEST(ExpectationWriter, ACaptureThatWasReplacedMeanwhileStaysTheNewOne) {
    const TemporaryFile file, other("other");
    record(file.path());
    record(other.path());
    auto writer = ExpectationWriter::extend(file.path());
    ASSERT_TRUE(writer && writer->add("of the old one"));
    std::filesystem::rename(other.path(), file.path());
    const auto finished = writer->finish();
    ASSERT_FALSE(finished);
    EXPECT_THAT(finished, FailsWith("expect.capture_replaced", Field("file", file.path().string())));
    EXPECT_TRUE(Capture::open(file.path())->expectations().empty());
}

TEST(ExpectationWriter, ImagesAreKnownSectionsToAReader) {
    const TemporaryFile file;
    record(file.path());
    auto writer = ExpectationWriter::extend(file.path());
    writer->add_image(texels(100, 1));
    ASSERT_TRUE(writer->add("text") && writer->finish());
    EXPECT_THAT(Capture::open(file.path())->summary().left_out, testing::IsEmpty());
}

TEST(ExpectationWriter, WhatIsNoCaptureIsRefusedAndLeftAlone) {
    const TemporaryFile file;
    const auto noise = texels(100, 1);
    write_file(file.path(), noise);
    EXPECT_FALSE(ExpectationWriter::extend(file.path()));
    EXPECT_EQ(read_file(file.path()), noise);
}

}  // namespace
}  // namespace strata
