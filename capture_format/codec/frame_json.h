// A frame as JSON text with the names of the schema, so that scripts and diffs can read what a capture says.
#pragma once

#include <string>

#include "capture_format/result.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// One object per table of schema/capture.fbs, `flatc` reads it back to the same bits: numbers have as many digits as that
/// takes. Bulk data (texels, positions, particles) is named by hash and size, as in the file; hashes are 64-bit integers, which
/// some readers round. Fails where a name is no UTF-8. The frame must pass check_frame().
Result<std::string> frame_json(const Frame&);

}  // namespace strata
