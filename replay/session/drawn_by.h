// Whose triangle a transparent fragment is of.
#pragma once

#include <cstdint>
#include <string>

namespace strata {

struct Frame;  // capture_format/frame.h

/// "draw 3 'pane'" or "emitter 0 'smoke'", by Fragment::submission.
std::string drawn_by(const Frame&, std::uint32_t submission);

}  // namespace strata
