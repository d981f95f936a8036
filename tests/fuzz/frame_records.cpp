#include "tests/fuzz/frame_records.h"

#include <cstring>

#include "capture_format/codec/encode_frame.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"

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

}  // namespace

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

}  // namespace strata
