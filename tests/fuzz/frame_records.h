// Frames as a fuzzer's records.
#pragma once

#include <vector>

#include "tests/fuzz/sealed_capture.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// The blobs of a frame as records, and its flatbuffer with numbers instead of their hashes.
std::vector<Record> records_of(const Frame&, RecordKind);

}  // namespace strata
