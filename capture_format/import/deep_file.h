// A deep OpenEXR file in memory, block by block. The headers are read by OpenEXR's own C library; blocks are unpacked here, so
// that no allocation follows a file's word, threads need no lock, and samples come as the planes they are stored in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/import/deep_window.h"
#include "capture_format/result.h"

struct libdeflate_decompressor;

namespace strata {

/// What a sample may have: the channels of these names. `count_` is how many there are.
enum class DeepChannel : std::uint32_t { red, green, blue, alpha, alpha_red, alpha_green, alpha_blue, gray, depth, back, count_ };

/// The samples of a scan line or a tile. Planes hold one float per sample, pixel after pixel; missing channels are filled in:
/// color from Y or black, alpha from A or 1, the back from Z. Plane 0, 1, 2 is red, green, blue.
struct DeepBlock {
    DeepWindow window;
    std::vector<std::uint32_t> begin;  ///< samples of pixel i (row by row) are begin[i] to begin[i + 1]
    std::array<std::span<const float>, 3> color, alpha;
    std::span<const float> depth, back;

    /// What the planes point into; kept from block to block, because fresh pages cost more than unpacking into old ones.
    struct Storage {
        struct Free {
            void operator()(libdeflate_decompressor*) const;
        };
        std::unique_ptr<libdeflate_decompressor, Free> inflater;
        std::vector<std::byte> counts, deltas, bytes;
        std::vector<std::vector<float>> planes;
    } storage;
};

class DeepFile {
public:
    /// `part` by name or number; empty: the first deep one. The bytes must outlive the file. Fails for what is no deep image
    /// with a channel Z, and for compressions that deep images do not have.
    static Result<DeepFile> open(std::span<const std::byte> file, std::string_view name, std::string_view part);

    const DeepWindow& data_window() const { return data_; }
    const DeepWindow& display_window() const { return display_; }
    bool has(DeepChannel channel) const { return source_[static_cast<std::size_t>(channel)] >= 0; }
    /// Channels that are not read, by name.
    const std::vector<std::string>& ignored() const { return ignored_; }
    /// Deep parts of the file, this one among them.
    std::uint32_t deep_parts() const { return deep_parts_; }

    std::size_t blocks() const { return blocks_.size(); }
    const DeepWindow& window(std::size_t block) const { return blocks_[block].window; }
    /// Samples of the blocks that have pixels in the window, from their tables of counts. Fails where there are more than `most`.
    Result<std::uint64_t> count_samples(const DeepWindow&, std::uint64_t most) const;
    /// Thread safe. Takes a block to reuse the memory of.
    Result<DeepBlock> read(std::size_t block, DeepBlock reused) const;

private:
    /// Where a block lies in the file.
    struct BlockLocation {
        DeepWindow window;
        std::uint64_t table_pixels = 0;  ///< of a whole line or tile
        std::span<const std::byte> counts, samples;
        std::uint64_t unpacked = 0;  ///< bytes of its samples, as the file says
    };
    /// A channel as it is stored.
    struct Stored {
        std::uint32_t type = 0;          ///< exr_pixel_type_t
        std::uint64_t bytes_before = 0;  ///< of a sample
    };
    struct Opening;

    Result<void> unpack_table(const BlockLocation&, DeepBlock::Storage&) const;
    Result<void> unpack_counts(const BlockLocation&, DeepBlock&) const;
    Result<void> unpack(std::span<const std::byte> packed, std::vector<std::byte>& unpacked, DeepBlock::Storage&) const;
    void set_planes(DeepBlock&) const;
    std::span<const float> plane(DeepBlock&, std::size_t channel) const;
    static Error damaged(const BlockLocation&, const Error&);

    DeepWindow data_, display_;
    std::uint32_t compression_ = 0, deep_parts_ = 0;
    std::vector<Stored> channels_;
    std::uint64_t sample_bytes_ = 0;                                           ///< of all channels
    std::array<int, static_cast<std::size_t>(DeepChannel::count_)> source_{};  ///< index into channels_, or -1
    std::vector<std::string> ignored_;
    std::vector<BlockLocation> blocks_;
};

}  // namespace strata
