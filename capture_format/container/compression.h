// zstd with every call checked: the one place of the capture format that calls it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "capture_format/result.h"

struct ZSTD_CCtx_s;

namespace strata {

/// zstd's default: 3 shrank a peer's captures 50 times at 400 MB/s; 19 gains a tenth and is a hundred times slower.
inline constexpr int compression_level = 3;

/// Makes zstd frames, one after the other, with tables that are kept in between: they take 0.3 ms to set up. Without memory it
/// throws std::bad_alloc, as everything else here that allocates.
class Compression {
public:
    /// Appends the bytes as one frame that states their number.
    void append(std::vector<std::byte>& to, std::span<const std::byte> bytes, int level = compression_level);
    /// The same for the bytes of several parts, one after the other, by that many threads beside this one: in jobs of 8 MiB,
    /// however many threads there are. Where none can be started, this one does it all.
    void append(std::vector<std::byte>& to, std::span<const std::span<const std::byte>> parts, unsigned threads = 0);

private:
    struct End {
        void operator()(ZSTD_CCtx_s*) const;
    };
    ZSTD_CCtx_s* context();

    std::unique_ptr<ZSTD_CCtx_s, End> context_;
};

/// Fails (bad input) unless the bytes are a zstd frame that states this size: only such a one is worth allocating for.
Result<void> check_frame_size(std::span<const std::byte> packed, std::uint64_t raw_bytes);
/// Fills `raw` with the content of a zstd frame. Fails (bad input) where that is damaged or has another size; without memory it
/// throws std::bad_alloc.
Result<void> decompress(std::span<const std::byte> packed, std::span<std::byte> raw);

}  // namespace strata
