// Files that were cut or overwritten: what is read is what was recorded, to the bit, and the rest is named with its place.
#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "capture_format/check_capture.h"
#include "capture_format/codec/encode_frame.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/expectation_writer.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Bytes encoded(const Frame& frame) {
    BlobCollector blobs;
    return encode_frame(frame, blobs);
}

/// Frames that build on each other, and what surrounds them.
struct Whole {
    std::vector<Bytes> frames;  ///< encoded
    Bytes file;
    std::vector<Section> sections;
};

Whole whole_capture() {
    const TemporaryFile file("whole.strata");
    Whole whole;
    auto recorder = Recorder::create(file.path(), "notes");
    Frame frame = rich_frame();
    for (int i = 0; i < 5; ++i) {
        frame.draws[0].to_world[3].x += .25;
        if (i == 3) frame.meshes[0].positions[0].x += 1;
        EXPECT_TRUE(recorder->record(frame));
        whole.frames.push_back(encoded(frame));
    }
    EXPECT_TRUE(recorder->finish());
    whole.file = read_file(file.path());
    const auto container = Container::open(file.path());
    whole.sections.assign(container->sections().begin(), container->sections().end());
    return whole;
}

/// How many frames end before the cut.
std::size_t frames_before(const Whole& whole, std::size_t cut) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 1 < whole.sections.size(); ++i)
        if (whole.sections[i].type == SectionType::frame && whole.sections[i + 1].offset <= cut) ++count;
    return count;
}

/// Refused; or, where that is allowed, read up to the cut.
void expect_read_up_to(const Whole& whole, std::size_t cut) {
    SCOPED_TRACE(fmt::format("cut at {} of {}", cut, whole.file.size()));
    const auto part = std::span(whole.file).first(cut);
    const auto refused = Capture::open(part, "cut.strata");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::bad_input);
    EXPECT_THAT(refused.error(), HasField("file", "cut.strata"));
    const auto capture = Capture::open(part, "cut.strata", Partial::allowed);
    const bool has_header = cut >= 16;
    ASSERT_EQ(bool(capture), has_header);
    if (!has_header) return;
    EXPECT_THAT(refused.error(), HasField("offset"));
    EXPECT_THAT(capture->summary().left_out, testing::ElementsAre(HasSubstr("offset")));
    ASSERT_EQ(capture->frame_count(), frames_before(whole, cut));
    for (std::size_t i = 0; i < capture->frame_count(); ++i) EXPECT_EQ(encoded(*capture->frame(i)), whole.frames[i]) << i;
}

TEST(Damage, ACaptureCutAtAnyBorderOrAnywhereIsReadUpToTheCut) {
    const Whole whole = whole_capture();
    for (const Section& section : whole.sections)
        for (const std::size_t cut : {section.offset - 1, section.offset, section.offset + 1}) expect_read_up_to(whole, cut);
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) expect_read_up_to(whole, random() % whole.file.size());
}

/// A reader never makes something up: frames are those that were recorded, or there is a sentence with the place.
void expect_truth_or_sentence(const Whole& whole, const Bytes& bytes, const Partial partial) {
    const auto capture = Capture::open(bytes, "overwritten.strata", partial);
    if (!capture) {
        EXPECT_EQ(capture.error().fault, Fault::bad_input);
        EXPECT_THAT(capture.error(), HasField("file", "overwritten.strata"));
        return;
    }
    for (std::size_t i = 0; i < capture->frame_count(); ++i) {
        const auto frame = capture->frame(i);
        if (frame) EXPECT_EQ(encoded(*frame), whole.frames[i]) << i;
        else
            EXPECT_THAT(frame.error(),
                        testing::AllOf(HasField("file", "overwritten.strata"), HasField("section"), HasField("offset")));
    }
}

TEST(Damage, OverwrittenBytesAreNoticedOrDoNotMatter) {
    const Whole whole = whole_capture();
    std::mt19937 random(2);
    std::size_t noticed = 0;
    for (int i = 0; i < 200; ++i) {
        Bytes bytes = whole.file;
        const std::size_t at = random() % bytes.size();
        bytes[at] ^= static_cast<std::byte>(1 + random() % 255);
        SCOPED_TRACE(fmt::format("at {}", at));
        noticed += Capture::open(bytes, "overwritten.strata") ? 0 : 1;
        expect_truth_or_sentence(whole, bytes, Partial::refused);
        expect_truth_or_sentence(whole, bytes, Partial::allowed);
    }
    EXPECT_GT(noticed, 0u);
}

/// A capture of every kind of section, extended once: its first directory is followed by expectations and a second directory.
Bytes capture_of_every_section() {
    const TemporaryFile file("every.strata");
    auto recorder = Recorder::create(file.path(), "notes");
    Texture picture{.name = "thumbnail", .format = TextureFormat::rgba8_srgb, .width = 1, .height = 1};
    picture.texels.resize(4);
    EXPECT_TRUE(recorder->thumbnail(picture) && recorder->record(rich_frame()) && recorder->record(triangle_frame()) &&
                recorder->finish());
    auto writer = ExpectationWriter::extend(file.path());
    writer->add_image(bytes_of("texels of an image"));
    EXPECT_TRUE(writer->add("{}") && writer->finish());
    return read_file(file.path());
}

TEST(CheckCapture, RefusesEveryChangeOfALowestOrHighestBit) {
    const TemporaryFile file;
    Bytes bytes = capture_of_every_section();
    write_file(file.path(), bytes);
    ASSERT_TRUE(check_capture(file.path()));
    for (const std::byte bit : {std::byte{0x01}, std::byte{0x80}})
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            bytes[at] ^= bit;
            write_file(file.path(), bytes);
            const auto sound = check_capture(file.path());
            ASSERT_FALSE(sound) << "byte " << at;
            EXPECT_EQ(sound.error().fault, Fault::bad_input);
            EXPECT_THAT(sound.error(), HasField("file", file.path().string())) << "byte " << at;
            bytes[at] ^= bit;
        }
}

TEST(CheckCapture, RefusesABlobOfNoFrameThatIsNotWhatItsHashSays) {
    const TemporaryFile file;
    write_file(file.path(), capture_of_every_section());
    BlobCollector blobs;
    blobs.put(bytes_of("of no frame"));
    PackedBlobs packed = blobs.pack()->front();
    packed.stored[8] ^= std::byte{1};
    auto writer = ContainerWriter::extend(file.path());
    ASSERT_TRUE(writer->add({SectionType::blobs, packed.version, packed.stored, packed.raw_bytes}) && writer->finish());
    const auto sound = check_capture(file.path());
    ASSERT_FALSE(sound);
    EXPECT_THAT(sound, FailsWith("capture.blob.hash", Field("blob", 0)));
}

TEST(Damage, AFileThatIsShortenedWhileItIsReadIsBadInput) {
    const TemporaryFile file;
    write_file(file.path(), whole_capture().file);
    const auto capture = Capture::open(file.path());
    ASSERT_TRUE(capture);
    std::filesystem::resize_file(file.path(), 16);
    const auto frame = capture->frame(capture->frame_count() - 1);
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().fault, Fault::bad_input);
    EXPECT_THAT(frame, FailsWith("file.shortened", Field("end", 16)));
}

/// Notes, picture and expectations are dispensable, and a partial capture goes without them.
TEST(Damage, WithoutItsNotesAPartialCaptureStillHoldsItsFrames) {
    Whole whole = whole_capture();
    ASSERT_EQ(whole.sections[0].type, SectionType::notes);
    whole.file[whole.sections[0].offset + 48] ^= std::byte{1};
    EXPECT_FALSE(Capture::open(whole.file, "notes.strata"));
    const auto capture = Capture::open(whole.file, "notes.strata", Partial::allowed);
    ASSERT_TRUE(capture);
    EXPECT_EQ(capture->frame_count(), whole.frames.size());
    EXPECT_THAT(capture->summary().left_out, testing::ElementsAre(HasSubstr("(notes)")));
}

}  // namespace
}  // namespace strata
