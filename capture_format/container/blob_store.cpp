// Packs and finds blobs. The grammar of a blobs section's payload:
//
//   blobs = count:u64  entry{count}  zstd frame
//   entry = hash_low:u64  hash_high:u64  bytes:u64                                                    in version 1
//   entry = hash_low:u64  hash_high:u64  bytes:u64  filtered_bytes:u64  filter                        in version 2
//   filter = shape:u16  step:u16  stride:u16  0:u16                                                   blob_filter.h
//
// The zstd frame holds the blobs one after the other, as their filters leave them, and states its decompressed size, which is
// the section's raw_bytes and the sum of the entries' (filtered) bytes. The index is not compressed: a reader knows where every
// blob is without decompressing any. A section without a filtered blob has version 1, so that older programs read it.
#include "capture_format/container/blob_store.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include <xxhash.h>

#include "capture_format/container/compression.h"
#include "capture_format/container/picture.h"

namespace strata {
namespace {

struct IndexEntry {
    BlobHash hash;
    std::uint64_t bytes = 0, filtered_bytes = 0;
    BlobFilter filter;
};
static_assert(sizeof(IndexEntry) == 40);

/// Of an entry in the file: version 1 has the front of it.
std::size_t entry_bytes(std::uint32_t version) {
    return version == 1 ? offsetof(IndexEntry, filtered_bytes) : sizeof(IndexEntry);
}

// Sections of so many bytes are packed by several threads, compressed in jobs of 8 MiB (zstd's, at this level). What is recorded
// bit by bit stays below: an application keeps its cores (only positions that lie on rays take a second one, in ray_records.cpp).
constexpr std::uint64_t least_for_threads = std::uint64_t{16} << 20;
unsigned threads() { return std::max(1u, std::thread::hardware_concurrency()); }

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

BlobLoan::~BlobLoan() {
    std::erase_if(blobs_.pending_, [&](const BlobCollector::Pending& pending) {
        if (!pending.own.empty()) return false;
        blobs_.known_.erase(pending.blob.hash);
        blobs_.pending_bytes_ -= pending.blob.bytes;
        return true;
    });
    blobs_.is_loan_ = false;
}

BlobName BlobCollector::put(std::span<const std::byte> bytes, std::size_t element_bytes) {
    const BlobName blob = {blob_hash(bytes), bytes.size()};
    if (bytes.empty() || !known_.insert(blob.hash).second) return blob;
    Pending& pending = pending_.emplace_back(Pending{blob, element_bytes, bytes});
    if (!is_loan_) pending.own.assign(bytes.begin(), bytes.end()), pending.bytes = pending.own;
    pending_bytes_ += bytes.size();
    return blob;
}

Result<std::vector<PackedBlobs>> BlobCollector::pack() {
    std::vector<PackedBlobs> packed;
    std::vector<Pending> pending = std::exchange(pending_, {});
    pending_bytes_ = 0;
    for (auto first = pending.begin(); first != pending.end();) {
        std::uint64_t bytes = 0;
        auto last = first;
        for (; last != pending.end() && last->blob.bytes <= largest_blobs_section - bytes; ++last) bytes += last->blob.bytes;
        if (last == first) {
            return fail(Fault::usage, "record.resource_too_large",
                        "a resource of {bytes} bytes is too large for a capture; the limit is {most}", first->blob.bytes,
                        largest_blobs_section);
        }
        packed.push_back(pack({first, last}));
        first = last;
    }
    return packed;
}

/// Rearranges the blobs that get smaller by it; says how.
std::vector<BlobFilter> BlobCollector::filter(std::span<Pending> blobs) {
    std::vector<BlobFilter> filters(blobs.size());
    std::uint64_t bytes = 0;
    for (const Pending& blob : blobs) bytes += blob.bytes.size();
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < blobs.size(); i = next++) {
            auto better = filtered(blobs[i].bytes, blobs[i].element_bytes);
            if (!better) continue;
            filters[i] = better->filter;
            blobs[i].own = std::move(better->bytes);
            blobs[i].bytes = blobs[i].own;
        }
    };
    std::vector<std::future<void>> helpers(bytes < least_for_threads ? 0 : threads() - 1);
    for (std::future<void>& helper : helpers) helper = std::async(work);
    work();
    for (std::future<void>& helper : helpers) helper.get();
    return filters;
}

/// One section. The blobs are compressed from where they are: a copy of them all would double what packing takes.
PackedBlobs BlobCollector::pack(std::span<Pending> blobs) {
    const std::uint64_t count = blobs.size();
    std::vector<IndexEntry> index;
    PackedBlobs section{.version = 1};
    const std::vector<BlobFilter> filters = filter(blobs);
    for (std::size_t i = 0; i < count; ++i) {
        index.push_back({blobs[i].blob.hash, blobs[i].blob.bytes, blobs[i].bytes.size(), filters[i]});
        if (filters[i] != BlobFilter{}) section.version = blobs_version;
        section.raw_bytes += blobs[i].bytes.size();
    }
    const std::size_t each = entry_bytes(section.version), index_bytes = sizeof(count) + count * each;
    section.stored.resize(index_bytes);
    std::memcpy(section.stored.data(), &count, sizeof(count));
    for (std::size_t i = 0; i < index.size(); ++i) std::memcpy(&section.stored[sizeof(count) + i * each], &index[i], each);
    append_compressed(section, blobs);
    return section;
}

/// The zstd frame of the blobs.
void BlobCollector::append_compressed(PackedBlobs& section, std::span<const Pending> blobs) {
    std::vector<std::span<const std::byte>> parts;
    for (const Pending& blob : blobs) parts.push_back(blob.bytes);
    Compression().append(section.stored, parts, section.raw_bytes < least_for_threads ? 0 : threads());
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
    const std::uint32_t version = section.type == SectionType::blobs ? section.version : 1;
    if (version < 1 || version > blobs_version) {
        return container_->located(
            number, fail(Fault::bad_input, "capture.blobs.version",
                         "the section has version {version}; this program reads 1 to {newest}: {advice}", version, blobs_version,
                         version > blobs_version ? "open it with a newer strata" : "it was not written by strata"));
    }
    const std::size_t each = entry_bytes(version);
    if (section.raw_bytes > largest_blobs_section) {
        return container_->located(
            number, fail(Fault::bad_input, "capture.blobs.too_large", "the section claims {bytes} bytes; the limit is {most}",
                         section.raw_bytes, largest_blobs_section));
    }
    const auto stored = container_->stored(number);
    if (!stored) return stored.error();
    std::uint64_t count = 0;
    if (stored->size() >= sizeof(count)) std::memcpy(&count, stored->data(), sizeof(count));
    if (stored->size() < sizeof(count) || count > (stored->size() - sizeof(count)) / each) {
        return container_->located(number, fail(Fault::bad_input, "capture.blobs.index_cut",
                                                "the section is too short for its index of {blobs} blobs", count));
    }
    BlobsSection blobs{.number = number, .index_bytes = sizeof(count) + count * each};
    std::uint64_t filtered_bytes = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        IndexEntry entry;
        std::memcpy(&entry, stored->data() + sizeof(count) + i * each, each);
        if (version == 1) entry.filtered_bytes = entry.bytes;
        if (entry.filtered_bytes > section.raw_bytes - filtered_bytes || entry.bytes > largest_blobs_section - blobs.raw_bytes)
            break;
        if (entry.filter == BlobFilter{} && entry.bytes != entry.filtered_bytes) break;
        places_.try_emplace(entry.hash, BlobLocation{sections_.size(), blobs.raw_bytes, entry.bytes});
        blobs.blobs.push_back({entry.hash, entry.bytes, entry.filtered_bytes, entry.filter});
        blobs.raw_bytes += entry.bytes;
        filtered_bytes += entry.filtered_bytes;
    }
    if (blobs.blobs.size() != count || filtered_bytes != section.raw_bytes) {
        return container_->located(
            number, fail(Fault::bad_input, "capture.blobs.index", "the section does not hold the bytes its index lists"));
    }
    raw_bytes_ += blobs.raw_bytes;
    stored_bytes_ += section.stored_bytes;
    sections_.push_back(std::move(blobs));
    return {};
}

Result<void> BlobStore::decompress(BlobsSection& blobs) {
    free(blobs);
    const Section& section = container_->sections()[blobs.number];
    const bool plain = std::ranges::all_of(blobs.blobs, [](const Blob& blob) { return blob.filter == BlobFilter{}; });
    // Besides its own bytes a filtered blob takes what it is made of, twice at the most.
    const std::uint64_t needed = section.stored_bytes + blobs.raw_bytes + (plain ? 0 : 2 * section.raw_bytes);
    if (needed > budget_->left()) free_unused();
    if (const auto room = budget_->has_room(needed, 1, container_->whereabouts(blobs.number)); !room) return room;
    auto unpacked = unpack(blobs);
    if (!unpacked) return unpacked.error();
    auto raw = plain ? *std::move(unpacked) : std::make_unique_for_overwrite<std::byte[]>(blobs.raw_bytes);
    std::uint64_t offset = 0, filtered_offset = 0;
    for (std::size_t i = 0; i < blobs.blobs.size(); ++i) {
        const Blob& blob = blobs.blobs[i];
        const std::span<std::byte> bytes(raw.get() + offset, blob.bytes);
        if (!plain && !undo_filter({unpacked->get() + filtered_offset, blob.filtered_bytes}, blob.filter, bytes)) {
            return container_->located(
                blobs.number,
                fail(Fault::bad_input, "capture.blob.filter",
                     "blob {blob} is rearranged in a way that this program does not know; open it with a newer strata", i));
        }
        if (blob_hash(bytes) != blob.hash) {
            return container_->located(blobs.number,
                                       fail(Fault::bad_input, "capture.blob.hash", "blob {blob} does not match its hash", i));
        }
        offset += blob.bytes;
        filtered_offset += blob.filtered_bytes;
    }
    if (const auto taken = budget_->take(blobs.raw_bytes, 1, container_->whereabouts(blobs.number)); !taken) return taken;
    blobs.bytes = std::move(raw);
    blobs.held = true;
    return {};
}

/// The content of its zstd frame.
Result<std::unique_ptr<std::byte[]>> BlobStore::unpack(const BlobsSection& blobs) const {
    const auto stored = container_->stored(blobs.number);
    if (!stored) return stored.error();
    const std::span<const std::byte> frame = std::span(*stored).subspan(blobs.index_bytes);
    const std::uint64_t raw_bytes = container_->sections()[blobs.number].raw_bytes;
    if (const auto sized = check_frame_size(frame, raw_bytes); !sized) return container_->located(blobs.number, sized.error());
    auto raw = std::make_unique_for_overwrite<std::byte[]>(raw_bytes);  // clearing it takes as long as undoing a filter
    if (const auto done = strata::decompress(frame, {raw.get(), raw_bytes}); !done)
        return container_->located(blobs.number, done.error());
    return raw;
}

Result<std::span<const std::byte>> BlobStore::find(const BlobName& blob) {
    if (blob.bytes == 0) return std::span<const std::byte>();
    const auto place = places_.find(blob.hash);
    if (place == places_.end() || place->second.bytes != blob.bytes) {
        return fail(Fault::bad_input, "capture.blob.missing", "the file lacks blob {hash} of {bytes} bytes", text(blob.hash),
                    blob.bytes);
    }
    BlobsSection& section = sections_[place->second.section];
    section.used = true;
    if (!section.held) {
        if (const Result<void> read = decompress(section); !read) return read.error();
    }
    return std::span<const std::byte>(section.bytes.get() + place->second.offset, blob.bytes);
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
    budget_->give_back(blobs.raw_bytes);
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
