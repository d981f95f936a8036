// Packs and finds blobs. The grammar of a blobs section's payload:
//
//   blobs = count:u64  entry{count}  zstd frame
//   entry = hash_low:u64  hash_high:u64  bytes:u64
//
// The zstd frame holds the blobs one after the other and states its decompressed size, which is the section's raw_bytes and
// the sum of the entries' bytes. The index is not compressed: a reader knows where every blob is without decompressing any.
#include "capture_format/container/blob_store.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>
#include <memory>
#include <utility>

#include <xxhash.h>
#include <zstd.h>

#include "capture_format/container/picture.h"

namespace strata {
namespace {

struct IndexEntry {
    BlobHash hash;
    std::uint64_t bytes;
};
static_assert(sizeof(IndexEntry) == 24);

// zstd's default: 3 shrank a peer's captures 50 times at 400 MB/s; 19 gains a tenth and is a hundred times slower.
constexpr int compression_level = 3;

}  // namespace

BlobHash blob_hash(std::span<const std::byte> bytes) {
    if (bytes.empty()) return {};
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return {hash.low64, hash.high64};
}

std::string text(const BlobHash& hash) { return fmt::format("{:016x}{:016x}", hash.high, hash.low); }

std::optional<BlobHash> parse_blob_hash(std::string_view digits) {
    constexpr std::size_t half = 16;
    BlobHash hash;
    const auto parse = [](std::string_view part, std::uint64_t& value) {
        const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), value, 16);
        return problem == std::errc() && end == part.data() + part.size();
    };
    if (digits.size() != 2 * half || !parse(digits.substr(0, half), hash.high) || !parse(digits.substr(half), hash.low))
        return {};
    return hash;
}

BlobName BlobCollector::put(std::span<const std::byte> bytes) {
    const BlobName blob = {blob_hash(bytes), bytes.size()};
    if (bytes.empty() || !known_.insert(blob.hash).second) return blob;
    pending_.push_back({blob.hash, {bytes.begin(), bytes.end()}});
    pending_bytes_ += bytes.size();
    return blob;
}

Result<std::vector<PackedBlobs>> BlobCollector::pack() {
    std::vector<PackedBlobs> packed;
    const std::vector<Pending> pending = std::exchange(pending_, {});
    pending_bytes_ = 0;
    for (auto first = pending.begin(); first != pending.end();) {
        std::uint64_t raw_bytes = 0;
        auto last = first;
        for (; last != pending.end() && last->bytes.size() <= largest_blobs_section - raw_bytes; ++last)
            raw_bytes += last->bytes.size();
        if (last == first) {
            return fail(Fault::usage, "a resource of {} bytes is too large for a capture, which takes up to {} at once",
                        first->bytes.size(), largest_blobs_section);
        }
        packed.push_back(pack({first, last}, raw_bytes));
        first = last;
    }
    return packed;
}

/// One section. The blobs are compressed from where they are: a copy of them all would double what packing takes.
PackedBlobs BlobCollector::pack(std::span<const Pending> blobs, std::uint64_t raw_bytes) {
    const std::uint64_t count = blobs.size();
    const std::size_t index_bytes = sizeof(count) + count * sizeof(IndexEntry);
    PackedBlobs section{.stored = std::vector<std::byte>(index_bytes + ZSTD_compressBound(raw_bytes)), .raw_bytes = raw_bytes};
    std::memcpy(section.stored.data(), &count, sizeof(count));
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        const IndexEntry entry = {blobs[i].hash, blobs[i].bytes.size()};
        std::memcpy(section.stored.data() + sizeof(count) + i * sizeof(IndexEntry), &entry, sizeof(IndexEntry));
    }
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, compression_level);
    ZSTD_CCtx_setPledgedSrcSize(context.get(), raw_bytes);
    ZSTD_outBuffer out = {section.stored.data() + index_bytes, section.stored.size() - index_bytes, 0};
    for (const Pending& blob : blobs) {
        ZSTD_inBuffer in = {blob.bytes.data(), blob.bytes.size(), 0};
        const ZSTD_EndDirective then = &blob == &blobs.back() ? ZSTD_e_end : ZSTD_e_continue;
        [[maybe_unused]] const std::size_t left = ZSTD_compressStream2(context.get(), &out, &in, then);
        assert(!ZSTD_isError(left) && in.pos == in.size);  // the bound is zstd's own
    }
    section.stored.resize(index_bytes + out.pos);
    return section;
}

Result<BlobStore> BlobStore::open(const Container& container, MemoryBudget& budget, SectionType type) {
    BlobStore store(container, budget);
    for (std::size_t i = 0; i < container.sections().size(); ++i) {
        const Section& section = container.sections()[i];
        if (section.type != type) continue;
        if (type == SectionType::expect && section.version != expect_images_version) continue;  // a text, or a later thing
        if (const Result<void> read = store.read_index(i); !read) return read.error();
    }
    return store;
}

Result<void> BlobStore::read_index(std::size_t number) {
    const Section& section = container_->sections()[number];
    if (section.type == SectionType::blobs && section.version != blobs_version) {
        return fail(Fault::bad_input, "{} has version {}; this program reads {}", container_->whereabouts(number),
                    section.version, blobs_version);
    }
    if (section.raw_bytes > largest_blobs_section) {
        return fail(Fault::bad_input, "{} claims {} bytes; a capture's sections have up to {}", container_->whereabouts(number),
                    section.raw_bytes, largest_blobs_section);
    }
    const auto stored = container_->stored(number);
    if (!stored) return stored.error();
    std::uint64_t count = 0;
    if (stored->size() >= sizeof(count)) std::memcpy(&count, stored->data(), sizeof(count));
    if (stored->size() < sizeof(count) || count > (stored->size() - sizeof(count)) / sizeof(IndexEntry)) {
        return fail(Fault::bad_input, "{} is too short for its index of {} blobs", container_->whereabouts(number), count);
    }
    BlobsSection blobs{.number = number, .hashes = {}, .sizes = {}, .bytes = {}};
    std::uint64_t offset = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        IndexEntry entry;
        std::memcpy(&entry, stored->data() + sizeof(count) + i * sizeof(IndexEntry), sizeof(IndexEntry));
        if (entry.bytes > section.raw_bytes - offset) break;
        places_.try_emplace(entry.hash, BlobLocation{sections_.size(), offset, entry.bytes});
        blobs.hashes.push_back(entry.hash);
        blobs.sizes.push_back(entry.bytes);
        offset += entry.bytes;
    }
    if (blobs.hashes.size() != count || offset != section.raw_bytes) {
        return fail(Fault::bad_input, "{} does not hold the bytes its index lists", container_->whereabouts(number));
    }
    raw_bytes_ += section.raw_bytes;
    stored_bytes_ += section.stored_bytes;
    sections_.push_back(std::move(blobs));
    return {};
}

Result<void> BlobStore::decompress(BlobsSection& blobs) {
    free(blobs);
    const Section& section = container_->sections()[blobs.number];
    const std::uint64_t needed = section.stored_bytes + section.raw_bytes;
    if (needed > budget_->left()) free_unused();
    if (const auto room = budget_->has_room(needed, 1, container_->whereabouts(blobs.number)); !room) return room;
    const auto stored = container_->stored(blobs.number);
    if (!stored) return stored.error();
    const std::span<const std::byte> frame =
        std::span(*stored).subspan(sizeof(std::uint64_t) + blobs.hashes.size() * sizeof(IndexEntry));
    const std::uint64_t raw_bytes = section.raw_bytes;
    // Only a frame that states the size the section states is worth allocating for.
    if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != raw_bytes) {
        return fail(Fault::bad_input, "{} is not a zstd frame of {} bytes", container_->whereabouts(blobs.number), raw_bytes);
    }
    std::vector<std::byte> raw(raw_bytes);
    const std::size_t written = ZSTD_decompress(raw.data(), raw.size(), frame.data(), frame.size());
    if (written != raw.size()) {
        return fail(Fault::bad_input, "{} does not decompress: {}", container_->whereabouts(blobs.number),
                    ZSTD_isError(written) ? ZSTD_getErrorName(written) : "it ends early");
    }
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < blobs.hashes.size(); ++i) {
        if (blob_hash(std::span(raw).subspan(offset, blobs.sizes[i])) != blobs.hashes[i]) {
            return fail(Fault::bad_input, "{}: blob {} is not what its hash says", container_->whereabouts(blobs.number), i);
        }
        offset += blobs.sizes[i];
    }
    blobs.bytes = std::move(raw);
    blobs.held = true;
    return budget_->take(raw_bytes, 1, container_->whereabouts(blobs.number));
}

Result<std::span<const std::byte>> BlobStore::find(const BlobName& blob) {
    if (blob.bytes == 0) return std::span<const std::byte>();
    const auto place = places_.find(blob.hash);
    if (place == places_.end() || place->second.bytes != blob.bytes) {
        return fail(Fault::bad_input, "the file lacks blob {} of {} bytes", text(blob.hash), blob.bytes);
    }
    BlobsSection& section = sections_[place->second.section];
    section.used = true;
    if (!section.held) {
        if (const Result<void> read = decompress(section); !read) return read.error();
    }
    return std::span<const std::byte>(section.bytes).subspan(place->second.offset, blob.bytes);
}

Result<void> BlobStore::check_all() {
    for (BlobsSection& section : sections_) {
        if (const Result<void> read = decompress(section); !read) return read;
        keep_only_used();
    }
    return {};
}

void BlobStore::free(BlobsSection& blobs) {
    if (!blobs.held) return;
    budget_->give_back(blobs.bytes.size());
    blobs.bytes = {};
    blobs.held = false;
}

void BlobStore::free_unused() {
    for (BlobsSection& section : sections_)
        if (!section.used) free(section);
}

void BlobStore::keep_only_used() {
    free_unused();
    for (BlobsSection& section : sections_) section.used = false;
}

std::size_t BlobStore::sections_held() const {
    return static_cast<std::size_t>(std::count_if(sections_.begin(), sections_.end(), [](const auto& s) { return s.held; }));
}

}  // namespace strata
