// What an application records is what is read, whatever happens to the process or the disk meanwhile.
#include "capture_format/recorder.h"

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <random>

#include <gmock/gmock.h>

#include "capture_format/codec/decode_frame.h"
#include "capture_format/codec/encode_frame.h"
#include "capture_format/container/container.h"
#include "capture_format/container/picture.h"
#include "capture_format/reader.h"
#include "tests/1_capture/frame_fields.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

void record(const std::filesystem::path& path, std::span<const Frame> frames) {
    auto recorder = Recorder::create(path);
    ASSERT_TRUE(recorder) << recorder.error().sentence;
    for (const Frame& frame : frames) {
        const auto recorded = recorder->record(frame);
        ASSERT_TRUE(recorded) << recorded.error().sentence;
    }
    ASSERT_TRUE(recorder->finish());
}

/// The frame's own error, whichever call the thread is in time for.
Result<void> record_and_flush(Recorder& recorder, const Frame& frame) {
    const auto recorded = recorder.record(frame);
    return recorded ? recorder.flush() : recorded;
}

TEST(Recorder, WhatWasRecordedIsWhatIsReadBitForBit) {
    const TemporaryFile file;
    const Frame frames[] = {rich_frame(), triangle_frame()};
    record(file.path(), frames);
    const auto capture = Capture::open(file.path());
    ASSERT_TRUE(capture) << capture.error().sentence;
    ASSERT_EQ(capture->frame_count(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto frame = capture->frame(i);
        ASSERT_TRUE(frame) << frame.error().sentence;
        EXPECT_EQ(bits_of(*frame), bits_of(frames[i]));
    }
}

TEST(Recorder, NamesAndNotesAreReadAsCleanText) {
    Frame frame = triangle_frame();
    frame.meshes.front().name = "\x1b[31mred\xff";
    const TemporaryFile file;
    auto recorder = Recorder::create(file.path(), "\x1b]0;mine\x07");
    ASSERT_TRUE(recorder && recorder->record(frame) && recorder->finish());
    const auto capture = Capture::open(file.path());
    EXPECT_EQ(capture->frame(0)->meshes.front().name, "\xef\xbf\xbd[31mred\xef\xbf\xbd");
    EXPECT_EQ(capture->summary().notes, "\xef\xbf\xbd]0;mine\xef\xbf\xbd");
}

TEST(Recorder, EveryFieldSurvivesEncodingWhateverItsBits) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Frame frame;
        RandomBits random{std::mt19937_64(seed)};
        walk(frame, random);
        const TemporaryFile file;
        BlobCollector blobs;
        const std::vector<std::byte> section = encode_frame(frame, blobs);
        auto writer = ContainerWriter::create(file.path());
        const PackedBlobs packed = blobs.pack()->front();
        ASSERT_TRUE(writer->add({SectionType::blobs, packed.version, packed.stored, packed.raw_bytes}) && writer->finish());
        const auto container = Container::open(file.path());
        MemoryBudget budget;
        auto store = BlobStore::open(*container, budget);
        const auto decoded = decode_frame(section, *store, budget);
        ASSERT_TRUE(decoded) << decoded.error().sentence;
        EXPECT_EQ(bits_of(*decoded), bits_of(frame)) << "seed " << seed;
    }
}

TEST(Recorder, CallByCallIsTheSameAsAWholeFrame) {
    const TemporaryFile file;
    const Frame frame = rich_frame();
    auto recorder = Recorder::create(file.path());
    recorder->begin_frame(frame.view, frame.time, frame.index, frame.seed);
    for (const Texture& texture : frame.textures) recorder->add_texture(texture);
    for (const Mesh& mesh : frame.meshes) recorder->add_mesh(mesh);
    for (const Material& material : frame.materials) recorder->add_material(material);
    for (const Draw& draw : frame.draws) recorder->draw(draw);
    for (const Emitter& emitter : frame.emitters) recorder->emitter(emitter);
    for (const Light& light : frame.lights) recorder->light(light);
    EXPECT_EQ(recorder->add_blocker(frame.blockers[0]), 0u);
    EXPECT_EQ(recorder->add_portal(frame.portals[0]), 0u);
    recorder->environment(frame.sun, frame.hemisphere, frame.fog, frame.background);
    for (const LightVolume& volume : frame.light_volumes) recorder->light_volume(volume);
    recorder->weather(frame.rain);
    recorder->camera(frame.lens, frame.film);
    for (const StageChoice& choice : frame.recorded_with) recorder->stage(choice);
    ASSERT_TRUE(recorder->end_frame());
    ASSERT_TRUE(recorder->finish());
    EXPECT_EQ(bits_of(*Capture::open(file.path())->frame(0)), bits_of(frame));
}

TEST(Recorder, EqualResourcesAcrossFramesAreStoredOnce) {
    const TemporaryFile one, ten("ten");
    const std::vector<Frame> frames(10, rich_frame());
    record(one.path(), std::span(frames).first(1));
    record(ten.path(), frames);
    const auto first = Capture::open(one.path());
    const auto all = Capture::open(ten.path());
    EXPECT_EQ(all->summary().blobs, first->summary().blobs);
    EXPECT_EQ(all->summary().blob_bytes_raw, first->summary().blob_bytes_raw);
    EXPECT_EQ(bits_of(*all->frame(9)), bits_of(frames[9]));
}

/// Frames that differ from each other, also in length.
std::vector<Frame> many_frames(std::size_t count) {
    std::vector<Frame> frames(count, rich_frame());
    for (std::size_t i = 0; i < count; ++i) {
        frames[i].index = i;
        frames[i].draws[1].to_world[3].x = std::sqrt(static_cast<double>(i));
        if (i % 7 == 3) frames[i].draws.push_back(frames[i].draws[0]);
    }
    return frames;
}

TEST(Recorder, FramesAreReadInAnyOrder) {
    const TemporaryFile file;
    const std::vector<Frame> frames = many_frames(100);
    record(file.path(), frames);
    const auto capture = Capture::open(file.path());
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i) {
        const std::size_t index = random() % frames.size();
        const auto frame = capture->frame(index);
        ASSERT_TRUE(frame) << frame.error().sentence;
        EXPECT_EQ(bits_of(*frame), bits_of(frames[index])) << index;
    }
}

TEST(Recorder, AFrameThatBuildsOnADamagedOneSaysSoAndTheNextKeyIsFine) {
    const TemporaryFile file;
    record(file.path(), many_frames(100));
    std::vector<std::size_t> sections;
    const auto container = Container::open(file.path());
    for (std::size_t i = 0; i < container->sections().size(); ++i)
        if (container->sections()[i].type == SectionType::frame) sections.push_back(i);
    std::vector<std::byte> bytes = read_file(file.path());
    bytes[container->sections()[sections[10]].offset + 48 + 30] ^= std::byte{1};
    const auto capture = Capture::open(bytes, "memory");
    EXPECT_TRUE(capture->frame(9));
    EXPECT_THAT(capture->frame(12), FailsWith("capture.section.checksum", Field("section", sections[10]), Field("kind", "frame"),
                                              Field("frame", 12)));
    EXPECT_TRUE(capture->frame(8)) << "what failed is forgotten";
    EXPECT_TRUE(capture->frame(64));
}

TEST(Recorder, AFileCopiedBeforeFinishIsReadableToItsLastFrame) {
    const TemporaryFile file, copy("copy");
    auto recorder = Recorder::create(file.path());
    ASSERT_TRUE(recorder->record(triangle_frame()) && recorder->record(rich_frame()) && recorder->flush());
    EXPECT_EQ(recorder->frames_written(), 2u);
    std::filesystem::copy_file(file.path(), copy.path(), std::filesystem::copy_options::overwrite_existing);
    const auto refused = Capture::open(copy.path());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::bad_input);
    EXPECT_THAT(refused, FailsWith("capture.no_directory"));
    const auto partial = Capture::open(copy.path(), Partial::allowed);
    ASSERT_TRUE(partial) << partial.error().sentence;
    EXPECT_TRUE(partial->summary().cut_short);
    ASSERT_EQ(partial->frame_count(), 2u);
    EXPECT_EQ(bits_of(*partial->frame(1)), bits_of(rich_frame()));
}

TEST(Recorder, AWriterKilledAnywhereLosesOnlyTheFrameItWasWriting) {
    const TemporaryFile file, cut("cut");
    auto recorder = Recorder::create(file.path());
    ASSERT_TRUE(recorder->record(triangle_frame()) && recorder->flush());
    const std::size_t one_frame = std::filesystem::file_size(file.path());
    ASSERT_TRUE(recorder->record(rich_frame()) && recorder->flush());
    const std::vector<std::byte> both = read_file(file.path());
    for (std::size_t size = one_frame; size < both.size(); size += 7) {
        write_file(cut.path(), std::span(both).first(size));
        const auto capture = Capture::open(cut.path(), Partial::allowed);
        ASSERT_TRUE(capture) << capture.error().sentence;
        ASSERT_EQ(capture->frame_count(), 1u);
        EXPECT_TRUE(capture->frame(0));
    }
}

TEST(Recorder, ADiskThatFillsUpKeepsTheWholeFrames) {
    const TemporaryFile file;
    auto recorder = Recorder::create(file.path());
    ASSERT_TRUE(recorder->record(triangle_frame()) && recorder->flush());
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit full = {std::filesystem::file_size(file.path()) + 500, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    const auto recorded = record_and_flush(*recorder, rich_frame());
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    ASSERT_FALSE(recorded);
    EXPECT_THAT(recorded, FailsWith("file.cannot_write", Field("file", file.path().string())));
    EXPECT_EQ(recorder->finish().error().sentence, recorded.error().sentence) << "a broken recorder stays broken";
    EXPECT_EQ(Capture::open(file.path(), Partial::allowed)->frame_count(), 1u);
}

TEST(Recorder, APathThatCannotBeWrittenIsAnErrorThatSaysWhy) {
    EXPECT_THAT(Recorder::create("/nowhere/x.strata"),
                FailsWith("file.cannot_write", Field("file", "/nowhere/x.strata"), Field("reason", "No such file or directory")));
    EXPECT_THAT(Recorder::create("/dev/full"),
                FailsWith("file.cannot_write", Field("file", "/dev/full"), Field("reason", "No space left on device")));
    EXPECT_EQ(Recorder::create(testing::TempDir()).error().fault, Fault::usage);
}

TEST(Recorder, CallsOutOfOrderAreErrors) {
    const TemporaryFile file, another("another"), last("last");
    const View view = triangle_frame().view;
    EXPECT_THAT(Recorder::create(file.path())->end_frame(), FailsWith("record.not_begun"));
    auto twice = Recorder::create(file.path());
    twice->begin_frame(view, 0, 0, 0);
    twice->begin_frame(view, 0, 0, 0);
    EXPECT_THAT(twice->end_frame(), FailsWith("record.begun_twice"));
    auto open = Recorder::create(another.path());
    open->begin_frame(view, 0, 0, 0);
    EXPECT_THAT(open->finish(), FailsWith("record.not_ended"));
    auto finished = Recorder::create(last.path());
    ASSERT_TRUE(finished->finish());
    EXPECT_THAT(finished->record(triangle_frame()), FailsWith("record.finished"));
}

TEST(Recorder, AFrameThatCouldNotBeReadIsNotWrittenAndTheNextOneIs) {
    const TemporaryFile file;
    Frame wrong = triangle_frame();
    wrong.draws[0].material = 5;
    auto recorder = Recorder::create(file.path());
    ASSERT_TRUE(recorder->record(triangle_frame()));
    const auto refused = record_and_flush(*recorder, wrong);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::usage);
    EXPECT_THAT(refused, FailsWith("frame.index_range", Field("list", "material"), Field("index", 5), Field("count", 1),
                                   Field("subject", "draw"), Field("name", "triangle"), Field("frame", 1)));
    ASSERT_TRUE(recorder->record(triangle_frame()) && recorder->finish()) << "it was reported once";
    EXPECT_EQ(Capture::open(file.path())->frame_count(), 2u);
}

TEST(Recorder, EqualCapturesHaveEqualIdsWhereverTheyLie) {
    const TemporaryFile here, there("there"), other("other");
    const Frame frames[] = {rich_frame(), triangle_frame()};
    record(here.path(), frames);
    record(there.path(), frames);
    record(other.path(), std::span(frames).first(1));
    const std::string id = Capture::open(here.path())->id();
    EXPECT_THAT(id, testing::MatchesRegex("[0-9a-f]{32}"));
    EXPECT_EQ(Capture::open(there.path())->id(), id);
    EXPECT_NE(Capture::open(other.path())->id(), id);
}

TEST(Recorder, ACaptureInMemoryIsTheCaptureInItsFile) {
    const TemporaryFile file;
    const Frame frame = rich_frame();
    record(file.path(), std::span(&frame, 1));
    std::vector<std::byte> bytes = read_file(file.path());
    const auto capture = Capture::open(bytes, "memory");
    bytes.assign(bytes.size(), std::byte{0});  // it keeps its own
    ASSERT_TRUE(capture) << capture.error().sentence;
    EXPECT_EQ(capture->id(), Capture::open(file.path())->id());
    EXPECT_EQ(bits_of(*capture->frame(0)), bits_of(frame));
    EXPECT_THAT(Capture::open(bytes, "memory"), FailsWith("capture.not_a_capture", Field("file", "memory")));
}

TEST(Recorder, NotesAndThumbnailTravelAlong) {
    const TemporaryFile file;
    const Texture picture{.name = "any",
                          .format = TextureFormat::rgba8_srgb,
                          .width = 2,
                          .height = 1,
                          .texels = std::vector<std::byte>(8, std::byte{7})};
    auto recorder = Recorder::create(file.path(), "a rainy night");
    ASSERT_TRUE(recorder->thumbnail(picture) && recorder->finish());
    const auto capture = Capture::open(file.path());
    EXPECT_EQ(capture->summary().notes, "a rainy night");
    EXPECT_EQ(capture->thumbnail().width, 2u);
    EXPECT_EQ(capture->thumbnail().texels, picture.texels);
    EXPECT_EQ(capture->frame_count(), 0u);
    EXPECT_THAT(capture->frame(0), FailsWith("capture.no_frame", Field("frame", 0), Field("frames", 0)));
}

TEST(Picture, TakesLessThanItsTexels) {
    Texture picture{.format = TextureFormat::rgba8_srgb, .width = 160, .height = 90};
    for (std::uint32_t i = 0; i < 160 * 90; ++i)  // a slope, opaque
        for (const std::uint32_t value : {i % 160, i / 160, 7u, 255u}) picture.texels.push_back(static_cast<std::byte>(value));
    const auto encoded = encode_picture(picture);
    ASSERT_TRUE(encoded);
    EXPECT_LT(encoded->size(), picture.texels.size() / 20);
    EXPECT_EQ(decode_picture(*encoded, picture_version)->texels, picture.texels);
}

TEST(Picture, TexelsOfTheFirstVersionAreRead) {
    const std::vector<std::byte> plain = {std::byte{1}, {}, {}, {}, std::byte{1}, {}, {}, {}, std::byte{9}, std::byte{8}, {}, {}};
    const auto picture = decode_picture(plain, 1);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->texels, std::vector(plain.begin() + 8, plain.end()));
}

TEST(Picture, PayloadsThatDoNotHoldTheirTexelsAreRefused) {
    Texture picture{.format = TextureFormat::rgba8_srgb, .width = 4, .height = 4, .texels = std::vector<std::byte>(64)};
    auto encoded = *encode_picture(picture);
    const auto refused = [](std::span<const std::byte> payload, std::uint32_t version) {
        const auto decoded = decode_picture(payload, version);
        EXPECT_THAT(decoded, FailsWith("capture.thumbnail", Field("most", 1024)));
    };
    refused(encoded, 1);
    refused(std::span(encoded).first(encoded.size() - 1), 2);
    refused(std::span(encoded).first(7), 2);
    for (const std::byte rows : {std::byte{3}, std::byte{5}, std::byte{0}}) {
        encoded[4] = rows;
        refused(encoded, 2);
    }
}

TEST(Recorder, AThumbnailOfAnotherShapeIsRefused) {
    const TemporaryFile file;
    auto recorder = Recorder::create(file.path());
    const Texture picture{.name = "any", .width = 2, .height = 2, .texels = std::vector<std::byte>(8)};
    EXPECT_THAT(recorder->thumbnail(picture), FailsWith("record.thumbnail"));
}

TEST(Recorder, ExpectationsAreAppendedAndDoNotChangeTheId) {
    const TemporaryFile file;
    const Frame frame = triangle_frame();
    record(file.path(), std::span(&frame, 1));
    const std::string id = Capture::open(file.path())->id();
    ASSERT_TRUE(append_expectation(file.path(), "display 1234"));
    ASSERT_TRUE(append_expectation(file.path(), "color 5678"));
    const auto capture = Capture::open(file.path());
    EXPECT_THAT(capture->expectations(), testing::ElementsAre("display 1234", "color 5678"));
    EXPECT_EQ(capture->id(), id);
    EXPECT_TRUE(capture->frame(0));
}

}  // namespace
}  // namespace strata
