// The whole of a capture, checked: what reading a frame never looks at, too.
#pragma once

#include <cstdint>
#include <filesystem>

#include "capture_format/result.h"

namespace strata {

/// Every byte: headers, padding and checksums; every blob, those of no frame and the images of expectations among them; every
/// index of every frame. Of sections of unknown types the checksum alone. What the texts of expectations say is not checked.
/// The memory budget is that of Capture::open().
Result<void> check_capture(const std::filesystem::path&, std::uint64_t memory_budget = 0);

}  // namespace strata
