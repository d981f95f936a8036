// What a capture file is: a header, sections, a directory.
#include "capture_format/container/container.h"

#include <gmock/gmock.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// Three sections with sizes that need padding, finished.
std::vector<std::byte> write_three(const std::filesystem::path& path) {
    auto writer = ContainerWriter::create(path);
    for (const std::string_view text : {"a note", "blobs would be here", "twelve bytes"}) {
        EXPECT_TRUE(writer->add({SectionType::notes, 1, bytes_of(text), text.size()}));
    }
    EXPECT_TRUE(writer->finish());
    return read_file(path);
}

std::string text(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

TEST(Container, AFileIsAHeaderSectionsAndADirectory) {
    const TemporaryFile file;
    write_three(file.path());
    const auto container = Container::open(file.path());
    ASSERT_TRUE(container) << container.error().sentence;
    EXPECT_FALSE(container->damage());
    ASSERT_EQ(container->sections().size(), 4u);
    EXPECT_EQ(container->sections()[0].offset, 16u);
    EXPECT_EQ(text(*container->stored(0)), "a note");
    EXPECT_EQ(text(*container->stored(2)), "twelve bytes");
    EXPECT_EQ(container->sections()[3].type, SectionType::directory);
}

TEST(Container, EveryPayloadIsAlignedForReadingInPlace) {
    const TemporaryFile file;
    write_three(file.path());
    const auto container = Container::open(file.path());
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(container->stored(i)->data()) % 8, 0u);
    }
}

TEST(Container, AFileCutAnywhereIsReadUpToTheCut) {
    const TemporaryFile file;
    const std::vector<std::byte> whole = write_three(file.path());
    const auto original = Container::open(file.path());
    const TemporaryFile cut("cut");
    for (std::size_t size = 16; size < whole.size(); ++size) {
        write_file(cut.path(), std::span(whole).first(size));
        const auto container = Container::open(cut.path());
        ASSERT_TRUE(container) << size;
        ASSERT_TRUE(container->damage()) << size;
        std::size_t still_whole = 0;
        while (still_whole < 3 && original->sections()[still_whole + 1].offset <= size) ++still_whole;
        EXPECT_EQ(container->sections().size(), still_whole) << size;
        EXPECT_THAT(container->damage(), HasField("offset"));
    }
}

TEST(Container, ADamagedSectionIsNamedWithItsOffset) {
    const TemporaryFile file;
    std::vector<std::byte> bytes = write_three(file.path());
    const std::uint64_t offset = Container::open(file.path())->sections()[1].offset;
    bytes[offset + 48 + 3] ^= std::byte{1};
    write_file(file.path(), bytes);
    const auto container = Container::open(file.path());
    EXPECT_TRUE(container->stored(0));
    const auto damaged = container->stored(1);
    ASSERT_FALSE(damaged);
    EXPECT_THAT(damaged,
                FailsWith("capture.section.checksum", Field("section", 1), Field("kind", "notes"), Field("offset", offset)));
}

TEST(Container, ADamagedDirectoryIsRebuiltByScanning) {
    const TemporaryFile file;
    std::vector<std::byte> bytes = write_three(file.path());
    bytes[bytes.size() - 40] ^= std::byte{1};
    write_file(file.path(), bytes);
    const auto container = Container::open(file.path());
    ASSERT_TRUE(container && container->damage());
    EXPECT_EQ(container->sections().size(), 3u);
    EXPECT_THAT(container->damage(), HasField("section", 3));
}

TEST(Container, WithoutADirectoryEveryByteOfASectionsHeaderCounts) {
    const TemporaryFile file;
    std::vector<std::byte> bytes = write_three(file.path());
    const auto finished = Container::open(file.path());
    const std::uint64_t offset = finished->sections()[1].offset;
    bytes.resize(finished->sections()[3].offset);
    ASSERT_EQ(Container::open(bytes, "whole.strata")->sections().size(), 3u);
    for (std::uint64_t at = offset; at < offset + 48; ++at) {
        std::vector<std::byte> damaged = bytes;
        damaged[at] ^= std::byte{1};
        const auto container = Container::open(damaged, "damaged.strata");
        EXPECT_EQ(container->sections().size(), 1u) << at - offset;
        EXPECT_THAT(container->damage(), HasField("section", 1)) << at - offset;
    }
}

TEST(Container, AFinishedFileIsExtendedByAppending) {
    const TemporaryFile file;
    const std::vector<std::byte> before = write_three(file.path());
    {
        auto writer = ContainerWriter::extend(file.path());
        ASSERT_TRUE(writer && writer->add({SectionType::expect, 1, bytes_of("all well"), 8}) && writer->finish());
    }
    const std::vector<std::byte> after = read_file(file.path());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
    const auto container = Container::open(file.path());
    EXPECT_FALSE(container->damage());
    ASSERT_EQ(container->sections().size(), 6u);  // three, their directory, one more, the new directory
    EXPECT_EQ(text(*container->stored(4)), "all well");
}

TEST(Container, SectionsOfUnknownTypesAreKept) {
    const TemporaryFile file;
    auto writer = ContainerWriter::create(file.path());
    ASSERT_TRUE(writer->add({SectionType{77}, 9, bytes_of("from the future"), 15}) && writer->finish());
    const auto container = Container::open(file.path());
    EXPECT_FALSE(container->damage());
    EXPECT_EQ(container->sections()[0].version, 9u);
    EXPECT_THAT(container->whereabouts(0), HasSubstr("(unknown)"));
}

TEST(Container, ANewerContainerIsRefused) {
    const TemporaryFile file;
    std::vector<std::byte> bytes = write_three(file.path());
    bytes[8] = std::byte{2};
    write_file(file.path(), bytes);
    const auto container = Container::open(file.path());
    ASSERT_FALSE(container);
    EXPECT_THAT(container, FailsWith("capture.container_version", Field("version", 2)));
}

TEST(Container, WhatIsNoCaptureIsRefused) {
    const TemporaryFile file;
    for (const std::string_view content : {"", "strata", "#version 460 and more than sixteen bytes of text"}) {
        write_file(file.path(), bytes_of(content));
        const auto container = Container::open(file.path());
        ASSERT_FALSE(container);
        EXPECT_THAT(container, FailsWith("capture.not_a_capture", Field("file", file.path().string())));
    }
    EXPECT_THAT(Container::open("/nowhere/x.strata"),
                FailsWith("file.cannot_open", Field("file", "/nowhere/x.strata"), Field("reason", "No such file or directory")));
    EXPECT_THAT(Container::open(testing::TempDir()), FailsWith("file.not_a_file"));
}

}  // namespace
}  // namespace strata
