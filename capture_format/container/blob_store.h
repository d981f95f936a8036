// Bulk bytes of a capture, addressed by what they are: equal bytes are stored once, in whichever frame they appear first.
// A blobs section is one zstd frame (per-record compression made a peer's files larger) with its index in front.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/container/blob_filter.h"
#include "capture_format/container/container.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata {

/// XXH3-128 of a blob's bytes; zero for no bytes at all.
struct BlobHash {
    std::uint64_t low = 0, high = 0;
    auto operator<=>(const BlobHash&) const = default;
};
BlobHash blob_hash(std::span<const std::byte>);
/// 32 hex digits, and back: nothing for any other text.
std::string text(const BlobHash&);
std::optional<BlobHash> parse_blob_hash(std::string_view);

/// A blob as a frame names it.
struct BlobName {
    BlobHash hash;
    std::uint64_t bytes = 0;
};

/// Newest grammar of a blobs section's payload.
inline constexpr std::uint32_t blobs_version = 2;
/// What one blobs section may hold decompressed, and so a blob: bounds what a hostile file can make a reader allocate.
inline constexpr std::uint64_t largest_blobs_section = std::uint64_t{1} << 30;

/// A blobs section ready to be written: Payload::version, Payload::stored and Payload::raw_bytes.
struct PackedBlobs {
    std::uint32_t version = blobs_version;
    std::vector<std::byte> stored = {};
    std::uint64_t raw_bytes = 0;
};

/// Writing: collects blobs until they are packed, and remembers for ever which ones there were.
class BlobCollector {
public:
    /// Keeps a copy of the bytes unless equal ones were put before. Lists of elements of more than one byte compress better
    /// when their size is known.
    BlobName put(std::span<const std::byte>, std::size_t element_bytes = 1);
    /// The blobs put since the last call as sections, none when there are no new ones. Fails for a blob above the limit.
    Result<std::vector<PackedBlobs>> pack();
    /// What pack() would compress now.
    std::uint64_t pending_bytes() const { return pending_bytes_; }

private:
    friend class BlobLoan;
    struct Pending {
        BlobName blob;
        std::size_t element_bytes = 1;
        std::span<const std::byte> bytes;
        std::vector<std::byte> own = {};  ///< what `bytes` refers to, except during a BlobLoan
    };
    static PackedBlobs pack(std::span<Pending>);
    static std::vector<BlobFilter> filter(std::span<Pending>);
    static void append_compressed(PackedBlobs&, std::span<const Pending>);

    std::set<BlobHash> known_;
    std::vector<Pending> pending_;
    std::uint64_t pending_bytes_ = 0;
    bool is_loan_ = false;
};

/// While it lasts, put() copies nothing: the bytes must stay where they are until the end of the loan. Blobs that were put
/// meanwhile and are not packed by then are forgotten.
class BlobLoan {
public:
    explicit BlobLoan(BlobCollector& blobs) : blobs_(blobs) { blobs_.is_loan_ = true; }
    BlobLoan(const BlobLoan&) = delete;
    BlobLoan& operator=(const BlobLoan&) = delete;
    ~BlobLoan();

private:
    BlobCollector& blobs_;
};

/// Reading: finds blobs by hash, decompresses a section when one of its blobs is asked for the first time.
class BlobStore {
public:
    /// Reads the indices of all blobs sections of frames, or of the images of expectations; decompresses nothing. The container
    /// and the budget, which sections are taken from while they are held, must outlive the store.
    static Result<BlobStore> open(const Container&, MemoryBudget&, SectionType = SectionType::blobs);

    /// The bytes of a blob, valid until keep_only_used().
    Result<std::span<const std::byte>> find(const BlobName&);
    /// Decompresses every section and compares every blob with its hash, those of no frame among them. Frees what find() gave.
    Result<void> check_all();
    /// Frees the sections of which no blob was asked for since the last call.
    void keep_only_used();

    std::size_t size() const { return places_.size(); }
    std::uint64_t raw_bytes() const { return raw_bytes_; }
    std::uint64_t stored_bytes() const { return stored_bytes_; }
    /// Decompressed sections held now.
    std::size_t sections_held() const;

private:
    struct BlobLocation {
        std::size_t section = 0;  ///< in sections_
        std::uint64_t offset = 0, bytes = 0;
    };
    struct Blob {
        BlobHash hash;
        std::uint64_t bytes = 0, filtered_bytes = 0;
        BlobFilter filter;
    };
    struct BlobsSection {
        std::size_t number = 0;  ///< in the container
        std::size_t index_bytes = 0;
        std::uint64_t raw_bytes = 0;  ///< of all blobs
        std::vector<Blob> blobs = {};
        std::unique_ptr<std::byte[]> bytes = {};
        bool held = false, used = false;
    };
    BlobStore(const Container& container, MemoryBudget& budget) : container_(&container), budget_(&budget) {}
    Result<void> read_index(std::size_t section);
    Result<void> decompress(BlobsSection&);
    Result<std::unique_ptr<std::byte[]>> unpack(const BlobsSection&) const;
    void free(BlobsSection&);
    void free_unused();

    const Container* container_;
    MemoryBudget* budget_;
    std::vector<BlobsSection> sections_;
    std::map<BlobHash, BlobLocation> places_;
    std::uint64_t raw_bytes_ = 0, stored_bytes_ = 0;
};

}  // namespace strata
