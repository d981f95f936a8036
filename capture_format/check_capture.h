// The whole of a capture, checked: what reading a frame never looks at, too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "capture_format/result.h"

namespace strata {

struct Frame;  // frame.h

/// Every byte: headers, padding and checksums; every blob, those of no frame and the images of expectations among them; every
/// index of every frame. Of sections of unknown types the checksum alone. What the texts of expectations say is not checked.
/// The memory budget is that of Capture::open(). `also` may find fault with a frame that is sound.
Result<void> check_capture(const std::filesystem::path&, std::uint64_t memory_budget = 0,
                           const std::function<Result<void>(const Frame&)>& also = {});

}  // namespace strata
