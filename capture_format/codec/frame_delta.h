// Frame sections since version 2: the flatbuffer of a frame, told as what changed since the frames before it. Knows which words
// repeat, go straight on or turn, and nothing else of what they mean; every bit survives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/container/compression.h"
#include "capture_format/result.h"

namespace strata {

/// What a frame section may hold unpacked: bounds what a hostile file makes a reader allocate. 700,000 draws fit.
inline constexpr std::uint64_t largest_frame_section = std::uint64_t{256} << 20;
/// What unpacking takes for every byte of a frame, and keeps until the next: the last four frames, what is unpacked, the
/// forecast, the frame, and which of its words move (half a byte).
inline constexpr std::uint64_t chain_bytes_per_byte = 8;
/// One frame in so many is told without the ones before it, a key. Any frame is then read by unpacking 64 at most, 0.1 s for 2000
/// draws; a key of 2000 moving draws takes 90 KB where another frame takes 1 to 4, so that 16 would double the file.
inline constexpr std::uint32_t frames_per_key = 64;

/// A run of frames, each told by the ones before it: one for writing, one for reading.
class FrameChain {
public:
    /// Words of a frame that continue those of the last one from `from` on; nowhere for words that continue none.
    struct Run {
        std::uint32_t from = 0, words = 0;
    };
    static constexpr std::uint32_t nowhere = 0xffffffff;

    /// The payload of the section that says `raw`, a frame's flatbuffer: whole words, at most largest_frame_section bytes. A word
    /// repeats in the next frame what the word `echo` before it is in this one, where that has been so. The runs make the whole
    /// frame; without any the frames are laid end to end.
    std::vector<std::byte> pack(std::span<const std::byte> raw, std::int64_t echo, std::vector<Run> runs = {});

    /// How many sections before it, up to a key, a payload needs unpacked first; 0 for a key.
    static Result<std::uint32_t> reach(std::span<const std::byte> payload);
    /// What pack() was given, 8-byte aligned, valid until the next call. Payloads come in order from a key on. After an error the
    /// chain is empty.
    Result<std::span<const std::byte>> unpack(std::span<const std::byte> payload, std::uint64_t raw_bytes);
    /// The last frame packed or unpacked, empty at first.
    std::span<const std::byte> newest() const { return std::as_bytes(std::span(history_[0])); }

private:
    using Words = std::vector<std::uint64_t>;
    Result<void> continue_with(std::span<const std::byte> payload, std::uint64_t raw_bytes);
    void rearrange(std::span<const Run>);
    void forecast(std::size_t words, std::ptrdiff_t echo);
    void remember(Words);
    void clear();

    std::array<Words, 4> history_;       ///< the frames before, newest first
    std::uint32_t known_ = 0;            ///< of them
    std::uint32_t reach_ = 0;            ///< frames since the key, which counts
    Words forecast_;                     ///< what every word of the next frame is expected to be
    std::vector<std::uint32_t> moving_;  ///< which words are expected to go on moving
    Compression compression_;
};

}  // namespace strata
