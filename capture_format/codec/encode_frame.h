// A frame becomes the payload of a frame section. Bulk data goes to the blobs, structure to flatbuffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/codec/stored_resources.h"
#include "capture_format/container/blob_store.h"

namespace strata {

/// The flatbuffer of a frame section, whole words of 8 bytes, for a frame whose resources were stored before; its own are not
/// looked at. Every field is written, so that -0 and NaN survive bit for bit. The frame must pass check_frame().
std::vector<std::byte> encode_frame(const Frame&, const StoredResources&, BlobCollector&);
/// The same for a frame with its own resources.
std::vector<std::byte> encode_frame(const Frame&, BlobCollector&);

/// From a draw's to_world to its previous_to_world, which repeats it a frame later, in words of 8 bytes; 0 without draws.
std::int64_t echo_of(std::span<const std::byte> section);

}  // namespace strata
