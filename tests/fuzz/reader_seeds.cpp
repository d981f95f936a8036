// Writes the first inputs of the reader's fuzzer into a folder. After the format has changed: run it, fuzz for a while, and put
// what -merge=1 keeps into corpus/reader.
#include <cstring>

#include "capture_format/codec/encode_frame.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/whole_file.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/fuzz/sealed_capture.h"

namespace strata {
namespace {

std::vector<std::span<const std::byte>> bulk_of(const Frame& frame) {
    std::vector<std::span<const std::byte>> bulk;
    for (const Texture& texture : frame.textures) bulk.push_back(std::span(texture.texels));
    for (const Mesh& mesh : frame.meshes)
        for (const auto bytes : {std::as_bytes(std::span(mesh.positions)), std::as_bytes(std::span(mesh.normals)),
                                 std::as_bytes(std::span(mesh.tangents)), std::as_bytes(std::span(mesh.uv0)),
                                 std::as_bytes(std::span(mesh.colors)), std::as_bytes(std::span(mesh.indices))})
            bulk.push_back(bytes);
    for (const Emitter& emitter : frame.emitters) bulk.push_back(std::as_bytes(std::span(emitter.particles)));
    return bulk;
}

/// The blobs of a frame as records, and its flatbuffer with numbers instead of their hashes.
std::vector<Record> records_of(const Frame& frame, RecordKind kind) {
    BlobCollector blobs;
    std::vector<std::byte> section = encode_frame(frame, blobs);
    std::vector<Record> records;
    for (const auto bytes : bulk_of(frame)) {
        const BlobHash hash = blob_hash(bytes);
        if (bytes.empty()) continue;
        for (std::size_t at = 0; at + sizeof(hash) <= section.size(); at += 4) {
            if (std::memcmp(&section[at], &hash, sizeof(hash)) != 0) continue;
            const std::uint64_t name[2] = {blob_mark, records.size()};
            std::memcpy(&section[at], name, sizeof(name));
        }
        records.push_back({.kind = RecordKind::blob, .bytes = {bytes.begin(), bytes.end()}});
    }
    records.push_back({.kind = kind, .type = 255, .bytes = section});
    return records;
}

bool write_seed(const std::filesystem::path& path, std::span<const Record> records) {
    std::vector<std::byte> input = text_of(records);
    input.insert(input.begin(), std::byte{0});
    return bool(write_whole_file(path, input));
}

/// Frames in which something moves and something is added: each but the first builds on those before.
std::vector<Record> moving() {
    Frame frame = triangle_frame();
    std::vector<Record> records = records_of(frame, RecordKind::frame);
    for (int i = 0; i < 3; ++i) {
        frame.draws[0].to_world[3].x += .5;
        if (i == 1) frame.fog.density = 1;
        if (i == 2) frame.draws.push_back(frame.draws[0]);
        records.push_back(records_of(frame, RecordKind::frame).back());
    }
    return records;
}

std::vector<Record> texts() {
    std::vector<Record> records = records_of(triangle_frame(), RecordKind::old_frame);
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{5, 4, 1, 77})
        records.push_back({RecordKind::section, type, 1, 0, std::vector<std::byte>(24, std::byte{'a'})});
    return records;
}

}  // namespace
}  // namespace strata

int main(int count, char** arguments) {
    using namespace strata;
    if (count != 2) return 2;
    const std::filesystem::path folder = arguments[1];
    const bool written = write_seed(folder / "rich", records_of(rich_frame(), RecordKind::frame)) &&
                         write_seed(folder / "rich_old", records_of(rich_frame(), RecordKind::old_frame)) &&
                         write_seed(folder / "moving", moving()) && write_seed(folder / "texts", texts());
    return written ? 0 : 3;
}
