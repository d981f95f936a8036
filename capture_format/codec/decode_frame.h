// The payload of a frame section becomes a frame. Trusts nothing: verifies the flatbuffer and bounds every allocation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "capture_format/container/blob_store.h"
#include "capture_format/result.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// Bulk bytes of one frame: a few kilobytes of hostile file may name the same blob a hundred thousand times.
inline constexpr std::uint64_t largest_frame_bytes = std::uint64_t{4} << 30;

/// That no offset leaves the bytes, all that is required is there, and the resources stay within the limit.
Result<void> verify_frame(std::span<const std::byte> section);

/// Verifies and decodes. Enums, indices and floats are as stored: check_frame() judges them. Fails (device lacks) where the
/// budget holds the frame and its blobs together no longer.
Result<Frame> decode_frame(std::span<const std::byte> section, BlobStore&, MemoryBudget&);

}  // namespace strata
