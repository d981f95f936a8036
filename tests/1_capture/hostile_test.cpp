// Files that lie. Whatever the bytes, opening ends with a sentence or with a frame that passes check_frame().
#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "capture_format/codec/decode_frame.h"
#include "capture_format/codec/encode_frame.h"
#include "capture_format/codec/upgrade.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using Bytes = std::vector<std::byte>;

Bytes small_capture() {
    const TemporaryFile file("original");
    auto recorder = Recorder::create(file.path(), "notes");
    EXPECT_TRUE(recorder->record(triangle_frame()) && recorder->record(rich_frame()) && recorder->finish());
    return read_file(file.path());
}

/// One to four changes: a bit, a byte that matters to parsers, a run of equal bytes, a piece moved elsewhere.
void mutate(Bytes& bytes, std::mt19937_64& random) {
    const auto place = [&] { return static_cast<std::size_t>(random() % bytes.size()); };
    constexpr std::byte telling[] = {std::byte{0}, std::byte{1}, std::byte{0x7f}, std::byte{0x80}, std::byte{0xff}};
    for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes) {
        const std::size_t at = place();
        const std::size_t length = std::min<std::size_t>(1 + random() % 16, bytes.size() - at);
        switch (random() % 4) {
            case 0:
                bytes[at] ^= static_cast<std::byte>(1u << random() % 8);
                break;
            case 1:
                bytes[at] = telling[random() % 5];
                break;
            case 2:
                std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, telling[random() % 5]);
                break;
            default: {
                const std::size_t from = std::min(place(), bytes.size() - length);
                std::copy_n(Bytes(bytes).begin() + static_cast<std::ptrdiff_t>(from), length,
                            bytes.begin() + static_cast<std::ptrdiff_t>(at));
            }
        }
    }
}

struct Outcome {
    int sentences = 0, frames = 0;
};

/// Opens a file in both ways and reads all its frames.
void open_fully(const std::filesystem::path& path, Outcome& outcome) {
    for (const Partial partial : {Partial::refused, Partial::allowed}) {
        const auto capture = Capture::open(path, partial);
        if (!capture) {
            EXPECT_FALSE(capture.error().sentence.empty());
            ++outcome.sentences;
            continue;
        }
        for (std::size_t i = 0; i < capture->frame_count(); ++i) {
            const auto frame = capture->frame(i);
            ++(frame ? outcome.frames : outcome.sentences);
            EXPECT_TRUE(frame ? bool(check_frame(*frame)) : !frame.error().sentence.empty());
        }
    }
}

TEST(HostileInput, ThousandsOfMutatedFilesEndWithASentenceOrAFrame) {
    const Bytes original = small_capture();
    const TemporaryFile file;
    Outcome outcome;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        std::mt19937_64 random(seed);
        Bytes bytes = original;
        mutate(bytes, random);
        if (seed % 10 == 0) bytes.resize(random() % bytes.size());
        write_file(file.path(), bytes);
        open_fully(file.path(), outcome);
    }
    EXPECT_GT(outcome.sentences, 1000);
    EXPECT_GT(outcome.frames, 1000);
}

/// The original's sections with one payload mutated and every checksum right again: what a forger would write.
void forge(const Container& original, const std::filesystem::path& path, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    auto writer = ContainerWriter::create(path);
    const std::size_t victim = random() % (original.sections().size() - 1);
    for (std::size_t i = 0; i + 1 < original.sections().size(); ++i) {
        const Section& section = original.sections()[i];
        const auto stored = *original.stored(i);
        Bytes payload(stored.begin(), stored.end());
        if (i == victim) mutate(payload, random);
        const std::uint64_t raw = i == victim && random() % 8 == 0 ? random() >> random() % 64 : section.raw_bytes;
        ASSERT_TRUE(writer->add({section.type, section.version, payload, raw}));
    }
    ASSERT_TRUE(writer->finish());
}

TEST(HostileInput, ThousandsOfForgedSectionsEndWithASentenceOrAFrame) {
    const TemporaryFile original, forged("forged");
    write_file(original.path(), small_capture());
    const auto container = Container::open(original.path());
    Outcome outcome;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        forge(*container, forged.path(), seed);
        open_fully(forged.path(), outcome);
    }
    EXPECT_GT(outcome.sentences, 1000);
    EXPECT_GT(outcome.frames, 1000);
}

TEST(HostileInput, AFrameThatClaimsMoreThanItMayIsRefusedBeforeAnythingIsCopied) {
    const TemporaryFile file;
    BlobCollector blobs;
    Bytes section = encode_frame(rich_frame(), blobs);
    const BlobHash texels = blob_hash(rich_frame().textures[0].texels);
    const auto hash = std::as_bytes(std::span(&texels, 1));
    const auto named = std::search(section.begin(), section.end(), hash.begin(), hash.end());
    ASSERT_NE(named, section.end());
    std::fill_n(named + 16, 8, std::byte{0xff});  // the blob's size follows its hash
    auto writer = ContainerWriter::create(file.path());
    ASSERT_TRUE(writer->add({SectionType::frame, 1, section, section.size()}) && writer->finish());
    const auto frame = Capture::open(file.path())->frame(0);
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame, FailsWith("capture.frame.resources_too_large", Field("most", 4294967296)));
}

TEST(HostileInput, AFrameSectionThatIsNoFlatbufferIsNamed) {
    const TemporaryFile file;
    auto writer = ContainerWriter::create(file.path());
    ASSERT_TRUE(writer->add({SectionType::frame, 1, bytes_of("no flatbuffer at all"), 20}) && writer->finish());
    const auto frame = Capture::open(file.path())->frame(0);
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame, FailsWith("capture.frame.not_a_frame", Field("section", 0), Field("kind", "frame"), Field("offset", 16)));
}

TEST(HostileInput, AFrameOfANewerVersionIsRefusedWhenTheFileIsOpened) {
    const TemporaryFile file;
    auto writer = ContainerWriter::create(file.path());
    ASSERT_TRUE(writer->add({SectionType::frame, format_version + 1, bytes_of("anything"), 8}) && writer->finish());
    EXPECT_THAT(Capture::open(file.path()),
                FailsWith("capture.frame.version", Field("version", format_version + 1), Field("newest", format_version)));
}

}  // namespace
}  // namespace strata
