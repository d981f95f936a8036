// The compressions of deep OpenEXR blocks: none, RLE, and deflate after a delta of bytes.
#pragma once

#include <cstddef>
#include <span>

struct libdeflate_decompressor;

namespace strata {

/// False where the packed bytes are not exactly `unpacked` long when unpacked.
bool unpack_rle(std::span<const std::byte> packed, std::span<std::byte> unpacked);
bool unpack_deflate(libdeflate_decompressor&, std::span<const std::byte> packed, std::span<std::byte> unpacked);

/// Undoes what OpenEXR does before it packs: bytes become their differences, after those at even places were put first.
/// `deltas` is changed on the way; both are equally long.
void undo_deltas(std::span<std::byte> deltas, std::span<std::byte> bytes);

}  // namespace strata
