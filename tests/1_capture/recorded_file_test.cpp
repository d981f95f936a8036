// The file that is recorded belongs to one recorder; what others do to it meanwhile is an error and no damaged capture that looks
// whole.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/frame_fields.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

/// A recorder that has written a frame.
Recorder begun(const std::filesystem::path& path) {
    auto recorder = Recorder::create(path);
    EXPECT_TRUE(recorder && recorder->record(triangle_frame()) && recorder->flush());
    return *std::move(recorder);
}

/// The error of writing one more frame, whichever call it comes from.
Result<void> one_more(Recorder& recorder) {
    const auto recorded = recorder.record(triangle_frame());
    return recorded ? recorder.flush() : recorded;
}

TEST(RecordedFile, BelongsToOneRecorderUntilItIsFinished) {
    const TemporaryFile file;
    {
        Recorder first = begun(file.path());
        EXPECT_THAT(Recorder::create(file.path()), FailsWith("file.in_use", Field("file", file.path().string())));
        ASSERT_TRUE(first.record(rich_frame()) && first.finish());
        EXPECT_EQ(bits_of(*Capture::open(file.path())->frame(1)), bits_of(rich_frame())) << "the second one has changed nothing";
        const int other = ::open(file.path().c_str(), O_RDWR | O_CLOEXEC);
        EXPECT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0) << "a recorder that is done lets go of its file";
        ::close(other);
    }
    auto next = Recorder::create(file.path());
    EXPECT_TRUE(next && next->finish());
    EXPECT_EQ(Capture::open(file.path())->frame_count(), 0u) << "an old capture is emptied";
}

TEST(RecordedFile, BelongsToOneProcess) {
    const TemporaryFile file;
    Recorder first = begun(file.path());
    const pid_t child = ::fork();
    if (child == 0) {
        const auto second = Recorder::create(file.path());
        ::_exit(!second && second.error().id == "file.in_use" ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(first.finish());
}

TEST(RecordedFile, DevicesAreForAll) {
    auto one = Recorder::create("/dev/null"), other = Recorder::create("/dev/null");
    ASSERT_TRUE(one && other);
    EXPECT_TRUE(one->record(triangle_frame()) && one->finish());
    EXPECT_TRUE(other->record(triangle_frame()) && other->finish());
}

TEST(RecordedFile, ThatIsDeletedIsAnError) {
    const TemporaryFile file;
    Recorder recorder = begun(file.path());
    std::filesystem::remove(file.path());
    EXPECT_THAT(recorder.finish(), FailsWith("file.deleted", Field("file", file.path().string())));
    Recorder replaced = begun(file.path());
    const TemporaryFile other("other");
    write_file(other.path(), bytes_of("another file"));
    std::filesystem::rename(other.path(), file.path());
    EXPECT_THAT(one_more(replaced), FailsWith("file.deleted"));
    EXPECT_EQ(file_text(file.path()), "another file");
}

TEST(RecordedFile, ThatIsMovedIsWholeWhereItIsAndAnErrorWhereItWas) {
    const TemporaryFile file, elsewhere("elsewhere");
    Recorder recorder = begun(file.path());
    std::filesystem::rename(file.path(), elsewhere.path());
    EXPECT_THAT(recorder.finish(), FailsWith("file.moved", Field("file", file.path().string())));
    EXPECT_EQ(Capture::open(elsewhere.path())->frame_count(), 1u);
}

TEST(RecordedFile, IsFoundAgainFromAnotherFolder) {
    const TemporaryFile file;
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(file.path().parent_path());
    Recorder recorder = begun(file.path().filename());
    std::filesystem::current_path("/");
    EXPECT_TRUE(recorder.finish());
    std::filesystem::current_path(here);
}

TEST(RecordedFile, ThatIsCutOrWrittenToIsAnErrorBeforeMoreIsWritten) {
    const TemporaryFile file;
    Recorder recorder = begun(file.path());
    const auto whole = std::filesystem::file_size(file.path());
    std::filesystem::resize_file(file.path(), whole - 10);
    EXPECT_THAT(one_more(recorder), FailsWith("file.changed", Field("bytes", whole - 10), Field("wanted", whole)));
    EXPECT_THAT(recorder.finish(), FailsWith("file.changed"));
    EXPECT_EQ(std::filesystem::file_size(file.path()), whole - 10);

    const TemporaryFile longer("longer");
    Recorder appended = begun(longer.path());
    std::ofstream(longer.path(), std::ios::app) << "something else";
    EXPECT_THAT(appended.finish(), FailsWith("file.changed", Field("bytes", whole + 14), Field("wanted", whole)));
}

TEST(Recorder, ThatWasMovedFromSaysSo) {
    const TemporaryFile file;
    Recorder from = begun(file.path());
    Recorder to = std::move(from);
    // NOLINTBEGIN(bugprone-use-after-move): that is the test
    const Frame frame = triangle_frame();
    from.begin_frame(frame.view, 0, 0, 0);
    EXPECT_EQ(from.add_texture({}), 0u);
    from.update_material(0, {});
    from.draw({});
    from.draws(frame.draws);
    from.weather({});
    for (const auto& result : {from.end_frame(), from.record(frame), from.thumbnail({}), from.flush(), from.finish()})
        EXPECT_THAT(result, FailsWith("record.moved_from"));
    EXPECT_EQ(from.frames_written(), 0u);
    EXPECT_EQ(from.load().held_bytes, 0u);
    // NOLINTEND(bugprone-use-after-move)
    EXPECT_TRUE(to.record(frame) && to.finish());
    EXPECT_EQ(Capture::open(file.path())->frame_count(), 2u);
}

TEST(Recorder, WhatIsTooLargeIsNamed) {
    const TemporaryFile file;
    auto recorder = Recorder::create(file.path(), {}, {.budget_bytes = 100'000});
    Frame frame = triangle_frame();
    frame.textures.resize(2);
    frame.textures[1] = {.name = "sky", .width = 256, .height = 256, .texels = std::vector<std::byte>(std::size_t{4} << 16)};
    EXPECT_THAT(recorder->record(frame),
                FailsWith("record.budget", Field("resource", "texture 1 'sky' of frame 0"), Field("budget", 100000)));
    frame.textures.clear();
    frame.draws.resize(500, frame.draws[0]);
    EXPECT_THAT(recorder->record(frame), FailsWith("record.budget", Field("resource", "frame 1 with 500 draws")));
    EXPECT_TRUE(recorder->record(triangle_frame()) && recorder->finish());
}

TEST(Recorder, AFrameOfAMillionDrawsSaysHowManyThereMayBe) {
    const TemporaryFile file;
    auto recorder = Recorder::create(file.path(), {}, {.budget_bytes = std::uint64_t{2} << 30});
    Frame frame = triangle_frame();
    frame.draws.resize(1'060'000, frame.draws[0]);
    const auto recorded = recorder->record(std::move(frame));
    const auto refused = recorded ? recorder->flush() : recorded;
    EXPECT_THAT(refused, FailsWith("record.frame_too_large", Field("frame", 0), Field("draws", 1060000), Field("most", 1 << 28)));
    EXPECT_TRUE(recorder->record(triangle_frame()) && recorder->finish()) << "the next frame is recorded";
    EXPECT_EQ(Capture::open(file.path())->frame_count(), 1u);
}

}  // namespace
}  // namespace strata
