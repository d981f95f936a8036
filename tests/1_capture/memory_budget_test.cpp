// A few kilobytes of file that unpack to much more are refused before they are unpacked: by bytes needed, the budget, what is
// left.
#include "capture_format/memory_budget.h"

#include <gmock/gmock.h>

#include "capture_format/check_capture.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;
constexpr std::uint64_t mib = std::uint64_t{1} << 20;

TEST(MemoryBudgets, AreHalfOfTheMachinesMemoryUnlessTheyAreGiven) {
    EXPECT_GT(default_memory_budget(), 64 * mib);
    EXPECT_EQ(MemoryBudget().left(), default_memory_budget());
    EXPECT_EQ(MemoryBudget(1000).left(), 1000u);
}

TEST(MemoryBudgets, RefuseWhatIsMoreThanIsLeftWithNumbers) {
    MemoryBudget budget(16 * mib);
    EXPECT_TRUE(budget.take(4, 3 * mib, "a"));
    EXPECT_TRUE(budget.has_room(1, 4 * mib, "b"));
    const auto refused = budget.take(5, mib, "image 7");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::device_lacks);
    EXPECT_THAT(refused, FailsWith("memory.budget", Field("what", "image 7"), Field("size", "5.0 MiB"), Field("count", 5),
                                   Field("each_bytes", mib), Field("budget", "16.0 MiB"), Field("left", "4.0 MiB")));
    EXPECT_FALSE(budget.take(~std::uint64_t{0}, ~std::uint64_t{0}, "a product that would wrap"));
    budget.give_back(12 * mib);
    EXPECT_EQ(budget.left(), 16 * mib);
}

/// A capture of a frame with zeros for texels.
std::string write_zeros(const TemporaryFile& file, std::uint32_t edge) {
    Frame frame = triangle_frame();
    Texture texture{.name = "zeros", .width = edge, .height = edge};
    texture.texels.resize(std::size_t{4} * edge * edge);
    frame.textures.push_back(std::move(texture));
    auto recorder = Recorder::create(file.path());
    EXPECT_TRUE(recorder->record(std::move(frame)) && recorder->finish());
    return file.path().string();
}

TEST(CaptureBudget, BoundsAFrameAndTheBlobsItComesFrom) {
    const TemporaryFile file;
    const std::string path = write_zeros(file, 2048);  // 16 MiB
    ASSERT_LT(std::filesystem::file_size(file.path()), 10000u);
    EXPECT_TRUE(Capture::open(path, Partial::refused, 40 * mib)->frame(0));
    for (const std::uint64_t budget : {24 * mib, 8 * mib}) {  // for one of the two; for none
        const auto frame = Capture::open(path, Partial::refused, budget)->frame(0);
        ASSERT_FALSE(frame) << budget;
        EXPECT_EQ(frame.error().fault, Fault::device_lacks);
        EXPECT_THAT(frame, FailsWith("memory.budget", Field("size", "16.0 MiB"), Field("file", path)));
    }
}

TEST(CaptureBudget, BoundsWhatAFrameUnpacksTo) {
    const TemporaryFile file;
    Frame frame = triangle_frame();
    frame.draws.resize(4000, frame.draws[0]);
    auto recorder = Recorder::create(file.path());
    ASSERT_TRUE(recorder->record(frame) && recorder->finish());
    const auto refused = Capture::open(file.path(), Partial::refused, 4 * mib)->frame(0);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::device_lacks);
    EXPECT_THAT(refused, FailsWith("memory.budget", Field("what", HasSubstr("(frame)"))));
    EXPECT_TRUE(Capture::open(file.path(), Partial::refused, 64 * mib)->frame(0));
}

TEST(CaptureBudget, IsFreeAgainWhenTheNextFrameIsRead) {
    const TemporaryFile file;
    auto recorder = Recorder::create(file.path());
    for (int i = 0; i < 6; ++i) {
        Frame frame = triangle_frame();
        Texture texture{.name = "one color", .width = 512, .height = 512};
        texture.texels.resize(mib, static_cast<std::byte>(i));
        frame.textures.push_back(std::move(texture));
        ASSERT_TRUE(recorder->record(std::move(frame)));
    }
    ASSERT_TRUE(recorder->finish());
    const auto capture = Capture::open(file.path(), Partial::refused, 4 * mib);  // two sections, and the frame's copy of one
    for (const std::size_t index : {0u, 1u, 2u, 3u, 4u, 5u, 0u, 5u, 3u}) {
        const auto frame = capture->frame(index);
        ASSERT_TRUE(frame) << index << frame.error().sentence;
    }
}

TEST(CaptureBudget, BoundsWhatValidatingUnpacks) {
    const TemporaryFile file;
    write_zeros(file, 2048);
    EXPECT_EQ(check_capture(file.path(), 8 * mib).error().fault, Fault::device_lacks);
    EXPECT_TRUE(check_capture(file.path(), 64 * mib));
}

TEST(BlobBudget, IsSharedByTheSectionsThatAreHeld) {
    const TemporaryFile file;
    BlobCollector blobs;
    std::vector<BlobName> names;
    auto writer = ContainerWriter::create(file.path());
    for (int i = 0; i < 3; ++i) {
        names.push_back(blobs.put(std::vector<std::byte>(4 * mib, static_cast<std::byte>(i + 1))));
        const auto packed = blobs.pack();
        for (const PackedBlobs& part : *packed)
            ASSERT_TRUE(writer->add({SectionType::blobs, part.version, part.stored, part.raw_bytes}));
    }
    ASSERT_TRUE(writer->finish());
    const auto container = Container::open(file.path());
    MemoryBudget budget(10 * mib);
    auto store = BlobStore::open(*container, budget);
    EXPECT_TRUE(store->find(names[0]) && store->find(names[1]) && store->find(names[0]));
    EXPECT_EQ(store->find(names[2]).error().fault, Fault::device_lacks);
    store->keep_only_used();
    store->keep_only_used();
    EXPECT_EQ(budget.left(), 10 * mib);
    EXPECT_TRUE(store->find(names[2]));
}

}  // namespace
}  // namespace strata
