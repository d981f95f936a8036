// record = kind:u8 type:u8 version:u8 claim:u8 bytes:u32 byte[bytes]; an input is any number of them.
#include "tests/fuzz/sealed_capture.h"

#include <algorithm>
#include <cstring>

#include "capture_format/codec/frame_delta.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"

namespace strata {
namespace {

struct Head {
    std::uint8_t kind, type, version, claim;
    std::uint32_t bytes;
};
static_assert(sizeof(Head) == 8);

/// Puts the hashes of blobs where the flatbuffer names them by number, and fills its last word.
std::vector<std::byte> with_hashes(const Record& frame, std::span<const BlobHash> blobs) {
    std::vector<std::byte> bytes = frame.bytes;
    bytes.resize((bytes.size() + 7) / 8 * 8);
    for (std::size_t at = 0; at + sizeof(BlobHash) <= bytes.size(); at += 4) {
        std::uint64_t words[2];
        std::memcpy(words, bytes.data() + at, sizeof(words));
        if (words[0] == blob_mark && words[1] < blobs.size()) std::memcpy(bytes.data() + at, &blobs[words[1]], sizeof(BlobHash));
    }
    return bytes;
}

/// Packs record after record into one file.
class Sealing {
public:
    explicit Sealing(ContainerWriter file) : file_(std::move(file)) {}

    bool add(const Record& record) {
        switch (record.kind) {
            case RecordKind::blob: {
                const BlobName name = blobs_.put(record.bytes);
                hashes_.push_back(name.hash);
                return true;
            }
            case RecordKind::frame: {
                if (record.bytes.empty()) return true;
                std::vector<std::byte> payload = chain_.pack(with_hashes(record, hashes_), record.claim);
                if (record.type < payload.size()) payload[record.type] ^= std::byte{record.version};
                return add_blobs() && write({SectionType::frame, 2, payload, (record.bytes.size() + 7) / 8 * 8});
            }
            case RecordKind::old_frame: {
                const std::vector<std::byte> payload = with_hashes(record, hashes_);
                return add_blobs() && write({SectionType::frame, 1, payload, payload.size()});
            }
            default: {
                const std::uint64_t raw = record.claim == 0 ? record.bytes.size() : std::uint64_t{1} << record.claim % 64;
                return write({SectionType{record.type}, record.version, record.bytes, raw});
            }
        }
    }
    bool finish() { return add_blobs() && bool(file_.finish()); }

private:
    bool write(const Payload& payload) { return bool(file_.add(payload)); }
    bool add_blobs() {
        const auto packed = blobs_.pack();
        return packed && std::ranges::all_of(*packed, [&](const PackedBlobs& part) {
                   return write({SectionType::blobs, part.version, part.stored, part.raw_bytes});
               });
    }

    ContainerWriter file_;
    BlobCollector blobs_;
    FrameChain chain_;
    std::vector<BlobHash> hashes_;
};

}  // namespace

std::vector<Record> parse_records(std::span<const std::byte> input) {
    std::vector<Record> records;
    while (input.size() >= sizeof(Head)) {
        Head head;
        std::memcpy(&head, input.data(), sizeof(head));
        input = input.subspan(sizeof(head));
        const auto bytes = input.first(std::min<std::size_t>(head.bytes, input.size()));
        input = input.subspan(bytes.size());
        const auto kind = static_cast<RecordKind>(head.kind % static_cast<std::uint8_t>(RecordKind::count_));
        records.push_back({kind, head.type, head.version, head.claim, {bytes.begin(), bytes.end()}});
    }
    return records;
}

std::vector<std::byte> text_of(std::span<const Record> records) {
    std::vector<std::byte> text;
    for (const Record& record : records) {
        const Head head = {static_cast<std::uint8_t>(record.kind), record.type, record.version, record.claim,
                           static_cast<std::uint32_t>(record.bytes.size())};
        const auto bytes = std::as_bytes(std::span(&head, 1));
        text.insert(text.end(), bytes.begin(), bytes.end());
        text.insert(text.end(), record.bytes.begin(), record.bytes.end());
    }
    return text;
}

bool seal(std::span<const Record> records, const std::filesystem::path& path) {
    auto file = ContainerWriter::create(path);
    if (!file) return false;
    Sealing sealing(*std::move(file));
    return std::ranges::all_of(records, [&](const Record& record) { return sealing.add(record); }) && sealing.finish();
}

}  // namespace strata
