#include "tests/7_tool/forged_captures.h"

#include <cstring>
#include <functional>
#include <limits>

#include <xxhash.h>

#include "capture_format/codec/encode_frame.h"
#include "capture_format/codec/frame_delta.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/recorder.h"
#include "captures/scenarios.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"

namespace strata {
namespace {

using Bytes = std::vector<std::byte>;
using Sections = std::vector<Payload>;

/// The bytes of a finished capture of these sections.
Bytes file_of(const Sections& sections) {
    const TemporaryFile file("forged.strata");
    auto writer = ContainerWriter::create(file.path());
    for (const Payload& section : sections) EXPECT_TRUE(writer->add(section));
    EXPECT_TRUE(writer->finish());
    return read_file(file.path());
}

/// A capture of a frame that no recorder would write, and a change of its flatbuffer.
Bytes with_frame(
    const Frame& frame, const std::function<void(Bytes&)>& change = [](Bytes&) {}) {
    BlobCollector blobs;
    Bytes section = encode_frame(frame, blobs);
    change(section);
    section.resize((section.size() + 7) / 8 * 8);
    const auto packed = *blobs.pack();
    const Bytes payload = FrameChain().pack(section, 0);
    Sections sections;
    for (const PackedBlobs& part : packed) sections.push_back({SectionType::blobs, part.version, part.stored, part.raw_bytes});
    sections.push_back({SectionType::frame, 2, payload, section.size()});
    return file_of(sections);
}

Bytes with_changed_frame(const std::function<void(Frame&)>& change) {
    Frame frame = rich_frame();
    change(frame);
    return with_frame(frame);
}

template <typename T>
Bytes overwritten(Bytes bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(value));
    return bytes;
}

// Where container.cpp's grammar has them; the first section begins at 16.
constexpr std::size_t version_at = 8, first_prefix = 16, stored_at = first_prefix + 16, seal_at = first_prefix + 40;

/// The first section claims so many bytes, and its seal is right again. The directory is gone, or it would be believed.
Bytes claiming(Bytes bytes, std::uint64_t stored) {
    bytes = overwritten(std::move(bytes), stored_at, stored);
    const XXH64_hash_t seal = XXH3_64bits(bytes.data() + first_prefix, 40);
    bytes = overwritten(std::move(bytes), seal_at, seal);
    bytes.resize(bytes.size() - 16);
    return bytes;
}

/// Plain numbers as the bytes they are in a file.
template <typename... Numbers>
Bytes packed(Numbers... numbers) {
    Bytes bytes((sizeof(numbers) + ...));
    std::size_t at = 0;
    ((std::memcpy(bytes.data() + at, &numbers, sizeof(numbers)), at += sizeof(numbers)), ...);
    return bytes;
}

/// Begins a zstd frame that says what it holds in 8 bytes (RFC 8878, 3.1.1); nothing follows.
struct [[gnu::packed]] ZstdHeader {
    std::uint32_t magic = 0xfd2fb528;
    std::uint8_t descriptor = 0xe0;
    std::uint64_t content;
};

/// A blobs section that says how many blobs it has, with one entry of so many bytes.
Bytes blobs(std::uint64_t count, std::uint64_t bytes) {
    return packed(count, std::uint64_t{1}, std::uint64_t{2}, bytes, ZstdHeader{.content = bytes});
}

/// A key frame, version 2, that unpacks to so many bytes: reach, runs, echo, hash.
Bytes frame(std::uint64_t bytes) {
    return packed(std::uint32_t{0}, std::uint32_t{0}, std::int64_t{0}, std::uint64_t{0}, ZstdHeader{.content = bytes});
}

void add_container_lies(std::vector<ForgedCapture>& forged) {
    const Bytes good = sound_capture();
    constexpr std::uint64_t four_gib = std::uint64_t{4} << 30;
    forged.push_back({"a newer container", overwritten(good, version_at, std::uint32_t{2}), "capture.container_version:"});
    forged.push_back({"a section of 4 GiB", claiming(good, four_gib), "capture.section.cut: kind=notes needed_bytes=4294967296"});
    forged.push_back({"a section of 2^64 - 8 bytes", claiming(good, ~std::uint64_t{7}), "capture.section.cut: kind=notes"});
    const Bytes newer(8);
    forged.push_back({"a newer frame", file_of({{SectionType::frame, 99, newer, 8}}), "capture.frame.version: version=99"});
}

void add_bulk_lies(std::vector<ForgedCapture>& forged) {
    constexpr std::uint64_t four_gib = std::uint64_t{4} << 30, bomb = std::uint64_t{256} << 20;
    const auto add = [&](const char* name, const char* id, const Payload& section) {
        forged.push_back({name, file_of({section}), id});
    };
    const Bytes many = blobs(std::uint64_t{1} << 40, 8), large = blobs(1, four_gib);
    add("2^40 blobs", "capture.blobs.index_cut: blobs=1099511627776", {SectionType::blobs, blobs_version, many, 8});
    add("a blob of 4 GiB", "capture.blobs.too_large: bytes=4294967296", {SectionType::blobs, blobs_version, large, four_gib});
    const Bytes large_frame = frame(four_gib), bomb_frame = frame(bomb);
    add("a frame of 4 GiB", "capture.frame.too_large: bytes=4294967296", {SectionType::frame, 2, large_frame, four_gib});
    add("a frame that is a bomb", "capture.section.decompress:", {SectionType::frame, 2, bomb_frame, bomb});
}

void add_frame_lies(std::vector<ForgedCapture>& forged) {
    const auto add = [&](const char* name, const char* id, const std::function<void(Frame&)>& change) {
        forged.push_back({name, with_changed_frame(change), id});
    };
    add("a mesh past its table", "frame.index_range: list=mesh index=7", [](Frame& frame) { frame.draws[0].mesh = 7; });
    add("a vertex past its mesh", "frame.vertex_range: index=1 vertex=9 vertices=3",
        [](Frame& frame) { frame.meshes[0].indices[1] = 9; });
    add("an unknown enum", "frame.unknown_value: property=\"lighting model\" value=99",
        [](Frame& frame) { frame.materials[0].lighting_model = LightingModel{99}; });
    add("a NaN", "frame.not_finite: property=time", [](Frame& frame) { frame.time = std::numeric_limits<double>::quiet_NaN(); });
    add("a texture of 2^31 texels each way", "frame.extent: most=16384",
        [](Frame& frame) { frame.textures[0].width = frame.textures[0].height = 1u << 31; });
    add("a view of 2^31 pixels each way", "frame.extent: most=16384",
        [](Frame& frame) { frame.view.width = frame.view.height = 1u << 31; });
    const auto at_word = [&](const char* name, std::size_t at, std::uint32_t value) {
        const auto change = [=](Bytes& section) { section = overwritten(std::move(section), at, value); };
        forged.push_back({name, with_frame(rich_frame(), change), "capture.frame.not_a_frame:"});
    };
    at_word("a root beyond the end", 0, 0x7fffffff);
    at_word("a root that is no table", 0, 4);
    forged.push_back({"a frame of zeros",
                      with_frame(rich_frame(), [](Bytes& section) { std::ranges::fill(section, std::byte{0}); }),
                      "capture.frame.not_a_frame:"});
}

}  // namespace

std::vector<ForgedCapture> forged_captures() {
    std::vector<ForgedCapture> forged;
    add_container_lies(forged);
    add_bulk_lies(forged);
    add_frame_lies(forged);
    return forged;
}

namespace {

Bytes small_capture(const std::string& notes, const std::function<void(Frame&)>& change) {
    const TemporaryFile file("sound.strata");
    auto recorder = Recorder::create(file.path(), notes);
    const auto scenario = find_scenario("three_panes");
    ScenarioOptions options{.frames = 4};
    options.width = 16;
    options.height = 9;
    for (std::uint32_t i = 0; i < options.frames; ++i) {
        Frame frame = (*scenario)->build(i, options);
        frame.materials[frame.draws.front().material].lighting_model = LightingModel::lambert;  // the wall behind the panes
        frame.lights.push_back({.position = frame.view.origin, .range = 100});
        change(frame);
        EXPECT_TRUE(recorder->record(frame));
    }
    EXPECT_TRUE(recorder->finish());
    return read_file(file.path());
}

}  // namespace

Bytes sound_capture() {
    return small_capture("three panes", [](Frame&) {});
}

Bytes capture_with_unknown_section() {
    const TemporaryFile file("unknown.strata");
    write_file(file.path(), small_capture("\x1b]0;mine\x07 \xff", [](Frame& frame) {
                   for (Mesh& mesh : frame.meshes) mesh.name = "\x1b[31mmesh\xc3";
                   for (Material& material : frame.materials)
                       material.name =
                           "material\x9b"
                           "2J\xe2\x82";
               }));
    auto writer = ContainerWriter::extend(file.path());
    EXPECT_TRUE(writer->add({SectionType{77}, 3, bytes_of("of the future"), 13}) && writer->finish());
    return read_file(file.path());
}

Bytes capture_recorded_with(const std::vector<StageChoice>& choices) {
    return small_capture("recorded with", [&](Frame& frame) { frame.recorded_with = choices; });
}

Bytes vast_capture() {
    return with_changed_frame([](Frame& frame) {
        Texture& texture = frame.textures[0];
        texture.width = texture.height = 16384;
        texture.mips = 1;
        texture.texels.assign(std::size_t{4} * texture.width * texture.height, std::byte{0});
    });
}

}  // namespace strata
