// A frame becomes the payload of a frame section. Bulk data goes to the blobs, structure to flatbuffers.
#pragma once

#include <cstddef>
#include <vector>

#include "capture_format/blob_store.h"
#include "capture_format/frame.h"

namespace strata {

/// The section's bytes. Every field is written, so that -0 and NaN survive bit for bit. The frame must pass check_frame().
std::vector<std::byte> encode_frame(const Frame&, BlobCollector&);

}  // namespace strata
