// Bulk bytes: stored once, found by what they are, decompressed when asked for.
#include "capture_format/container/blob_store.h"

#include <cstring>
#include <optional>

#include <gmock/gmock.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

/// Writes what the collector holds as one more section.
void write_pending(ContainerWriter& writer, BlobCollector& blobs) {
    const auto packed = blobs.pack();
    ASSERT_TRUE(packed);
    for (const PackedBlobs& part : *packed) {
        ASSERT_TRUE(writer.add({SectionType::blobs, part.version, part.stored, part.raw_bytes}));
    }
}

/// A file with "first" in one section, "second" and "third" in the next.
struct TwoSections {
    TemporaryFile file;
    BlobCollector blobs;
    BlobName first = blobs.put(bytes_of("first")), second, third;
    std::optional<Container> container;

    TwoSections() {
        auto writer = ContainerWriter::create(file.path());
        write_pending(*writer, blobs);
        second = blobs.put(bytes_of("second"));
        third = blobs.put(bytes_of("third"));
        write_pending(*writer, blobs);
        EXPECT_TRUE(writer->finish());
        container = *Container::open(file.path());
    }
};

/// A file whose only section is the given blobs payload; the error of opening it and finding the blob.
Result<void> found_in(const PackedBlobs& blobs, const BlobName& blob) {
    const TemporaryFile file;
    auto writer = ContainerWriter::create(file.path());
    EXPECT_TRUE(writer->add({SectionType::blobs, blobs.version, blobs.stored, blobs.raw_bytes}) && writer->finish());
    const auto container = Container::open(file.path());
    MemoryBudget budget;
    auto store = BlobStore::open(*container, budget);
    if (!store) return store.error();
    const auto found = store->find(blob);
    return found ? Result<void>() : found.error();
}

TEST(BlobStore, EqualBytesAreStoredOnce) {
    BlobCollector blobs;
    const BlobName once = blobs.put(bytes_of("the same"));
    EXPECT_EQ(blobs.put(bytes_of("the same")).hash, once.hash);
    const auto packed = blobs.pack();
    ASSERT_EQ(packed->size(), 1u);
    EXPECT_EQ(packed->front().raw_bytes, 8u);
    blobs.put(bytes_of("the same"));
    EXPECT_TRUE(blobs.pack()->empty());
}

TEST(BlobStore, WhatWasPutIsFound) {
    TwoSections written;
    MemoryBudget budget;
    auto store = BlobStore::open(*written.container, budget);
    ASSERT_TRUE(store) << store.error().sentence;
    EXPECT_EQ(store->size(), 3u);
    EXPECT_TRUE(std::ranges::equal(*store->find(written.first), bytes_of("first")));
    EXPECT_TRUE(std::ranges::equal(*store->find(written.third), bytes_of("third")));
}

TEST(BlobStore, NoBytesNeedNoBlob) {
    TwoSections written;
    MemoryBudget budget;
    auto store = BlobStore::open(*written.container, budget);
    EXPECT_EQ(written.blobs.put({}).hash, BlobHash{});
    EXPECT_TRUE(store->find({})->empty());
}

TEST(BlobStore, ASectionIsDecompressedWhenFirstAskedForAndFreedWhenNoLongerUsed) {
    TwoSections written;
    MemoryBudget budget;
    auto store = BlobStore::open(*written.container, budget);
    EXPECT_EQ(store->sections_held(), 0u);
    ASSERT_TRUE(store->find(written.first));
    EXPECT_EQ(store->sections_held(), 1u);
    store->keep_only_used();
    ASSERT_TRUE(store->find(written.second));
    EXPECT_EQ(store->sections_held(), 2u);
    store->keep_only_used();
    EXPECT_EQ(store->sections_held(), 1u);
}

/// 40,000 bytes that a filter makes smaller.
std::vector<std::byte> indices() {
    std::vector<std::uint32_t> values(10000);
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = i;
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

TEST(BlobStore, ASectionHasTheOlderVersionUnlessABlobIsRearranged) {
    BlobCollector blobs;
    blobs.put(indices());
    EXPECT_EQ(blobs.pack()->front().version, 1u);
    BlobCollector of_words;
    of_words.put(indices(), 4);
    const PackedBlobs packed = of_words.pack()->front();
    EXPECT_EQ(packed.version, 2u);
    EXPECT_LT(packed.stored.size(), 500u) << "of 40000 bytes";
}

TEST(BlobStore, LargeSectionsComeBackAndAreTheSameEveryTime) {
    const TemporaryFile file;
    std::vector<std::uint32_t> values(std::size_t{5} << 20);  // 20 MiB: several threads pack them
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = i * 2654435761u % 100000;
    const auto bytes = std::as_bytes(std::span(values));
    BlobCollector blobs, again;
    const BlobName name = blobs.put(bytes, 4), other = blobs.put(indices(), 4);
    again.put(bytes, 4), again.put(indices(), 4);
    EXPECT_EQ(blobs.pack()->front().stored, again.pack()->front().stored);
    BlobCollector written;
    written.put(bytes, 4), written.put(indices(), 4);
    auto writer = ContainerWriter::create(file.path());
    write_pending(*writer, written);
    ASSERT_TRUE(writer->finish());
    const auto container = Container::open(file.path());
    MemoryBudget budget;
    auto store = BlobStore::open(*container, budget);
    EXPECT_TRUE(std::ranges::equal(*store->find(name), bytes));
    EXPECT_TRUE(std::ranges::equal(*store->find(other), indices()));
}

TEST(BlobLoan, BytesAreReadWhenTheyArePacked) {
    BlobCollector blobs, copied;
    const auto first = bytes_of("first");
    std::vector<std::byte> lent(first.begin(), first.end());
    copied.put(bytes_of("later"));
    const BlobLoan loan(blobs);
    blobs.put(lent);
    std::ranges::copy(bytes_of("later"), lent.begin());
    const auto packed = blobs.pack(), wanted = copied.pack();
    // Behind the index with its hash the two sections are equal.
    constexpr std::size_t index_bytes = 32;
    EXPECT_TRUE(std::ranges::equal(std::span(packed->front().stored).subspan(index_bytes),
                                   std::span(wanted->front().stored).subspan(index_bytes)));
}

TEST(BlobLoan, WhatIsNotPackedAtItsEndIsForgotten) {
    BlobCollector blobs;
    blobs.put(bytes_of("kept"));
    {
        const BlobLoan loan(blobs);
        blobs.put(bytes_of("lent"));
    }
    EXPECT_EQ(blobs.pending_bytes(), 4u);
    EXPECT_EQ(blobs.pack()->front().raw_bytes, 4u);
    blobs.put(bytes_of("lent"));
    EXPECT_EQ(blobs.pack()->size(), 1u) << "it counts as new";
}

TEST(BlobStore, RearrangedBlobsAreFoundBesideOthers) {
    const TemporaryFile file;
    BlobCollector blobs;
    const BlobName first = blobs.put(bytes_of("first")), rearranged = blobs.put(indices(), 4), last = blobs.put(bytes_of("last"));
    auto writer = ContainerWriter::create(file.path());
    write_pending(*writer, blobs);
    ASSERT_TRUE(writer->finish());
    const auto container = Container::open(file.path());
    MemoryBudget budget;
    auto store = BlobStore::open(*container, budget);
    ASSERT_TRUE(store) << store.error().sentence;
    EXPECT_EQ(store->raw_bytes(), 5u + 40000u + 4u);
    EXPECT_TRUE(std::ranges::equal(*store->find(first), bytes_of("first")));
    EXPECT_TRUE(std::ranges::equal(*store->find(rearranged), indices()));
    EXPECT_TRUE(std::ranges::equal(*store->find(last), bytes_of("last")));
}

TEST(BlobStore, WhatANewerProgramWroteIsRefusedWithWhatToDo) {
    BlobCollector blobs;
    const BlobName blob = blobs.put(indices(), 4);
    PackedBlobs packed = blobs.pack()->front();
    constexpr std::size_t filter = 8 + 32;  // after the count and the entry's hash and sizes
    packed.stored[filter] = std::byte{9};
    EXPECT_THAT(found_in(packed, blob), FailsWith("capture.blob.filter", Field("blob", 0)));
    packed.version = 3;
    EXPECT_THAT(found_in(packed, blob), FailsWith("capture.blobs.version", Field("version", 3), Field("newest", 2)));
}

TEST(BlobStore, ARearrangedBlobOfAWrongSizeIsRefused) {
    BlobCollector blobs;
    const BlobName blob = blobs.put(indices(), 4);
    PackedBlobs packed = blobs.pack()->front();
    const std::uint64_t claimed = 39996;
    std::memcpy(packed.stored.data() + 24, &claimed, 8);
    EXPECT_THAT(found_in(packed, {blob.hash, claimed}), FailsWith("capture.blob.filter", Field("blob", 0)));
    const std::uint64_t large = largest_blobs_section + 1;
    std::memcpy(packed.stored.data() + 24, &large, 8);
    EXPECT_THAT(found_in(packed, {blob.hash, large}), FailsWith("capture.blobs.index", Field("section", 0)));
}

/// Nothing undoes a filter that is none, so nothing else would compare the two sizes.
TEST(BlobStore, ABlobThatIsNotRearrangedHasOneSize) {
    BlobCollector blobs;
    const BlobName blob = blobs.put(indices(), 4);
    PackedBlobs packed = blobs.pack()->front();
    const std::uint64_t filtered = 40000, claimed = 1 << 29;
    std::memcpy(packed.stored.data() + 24, &claimed, 8);
    std::memcpy(packed.stored.data() + 32, &filtered, 8);
    std::memset(packed.stored.data() + 40, 0, 8);  // the filter
    EXPECT_THAT(found_in(packed, {blob.hash, claimed}), FailsWith("capture.blobs.index", Field("section", 0)));
}

TEST(BlobStore, AnUnknownHashIsAnErrorThatNamesIt) {
    TwoSections written;
    MemoryBudget budget;
    auto store = BlobStore::open(*written.container, budget);
    EXPECT_THAT(store->find({{1, 2}, 4}),
                FailsWith("capture.blob.missing", Field("hash", "00000000000000020000000000000001"), Field("bytes", 4)));
    EXPECT_FALSE(store->find({written.first.hash, 4})) << "the right hash with a wrong size is another blob";
}

TEST(BlobStore, ABlobUnderAWrongHashIsRefused) {
    BlobCollector blobs;
    BlobName blob = blobs.put(bytes_of("honest"));
    PackedBlobs packed = blobs.pack()->front();
    blob.hash.low ^= 1;
    std::memcpy(packed.stored.data() + 8, &blob.hash.low, 8);
    EXPECT_THAT(found_in(packed, blob), FailsWith("capture.blob.hash", Field("blob", 0), Field("section", 0)));
}

TEST(BlobStore, SizesAreBoundedBeforeAnythingIsAllocated) {
    BlobCollector blobs;
    const BlobName blob = blobs.put(bytes_of("small"));
    PackedBlobs packed = blobs.pack()->front();
    packed.raw_bytes = ~std::uint64_t{0};
    EXPECT_THAT(found_in(packed, blob), FailsWith("capture.blobs.too_large", Field("most", 1073741824)));

    const std::uint64_t claimed = std::uint64_t{1} << 29;
    packed.raw_bytes = claimed;
    std::memcpy(packed.stored.data() + 24, &claimed, 8);
    EXPECT_THAT(found_in(packed, {blob.hash, claimed}), FailsWith("capture.section.zstd_size", Field("bytes", 536870912)));
}

TEST(BlobStore, AnIndexThatLeavesItsSectionIsRefused) {
    BlobCollector blobs;
    const BlobName blob = blobs.put(bytes_of("small"));
    PackedBlobs packed = blobs.pack()->front();
    for (const std::uint64_t count : {std::uint64_t{1000}, std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
        std::memcpy(packed.stored.data(), &count, 8);
        EXPECT_THAT(found_in(packed, blob), FailsWith("capture.blobs.index_cut", Field("blobs", count)));
    }
    packed.stored.resize(3);
    EXPECT_THAT(found_in(packed, blob), FailsWith("capture.blobs.index_cut", Field("blobs", 0)));
}

}  // namespace
}  // namespace strata
