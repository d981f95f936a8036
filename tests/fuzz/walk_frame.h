// What the rest of the program does with a frame that check_frame() let through: index it without asking again.
#pragma once

#include <filesystem>

namespace strata {

struct Frame;  // capture_format/frame.h

/// Follows every index and reads every texel, vertex and particle; the sanitizers judge. Returns a sum, so that nothing of it is
/// left out.
double walk(const Frame&);

/// Ends the program unless the frame, written to that file and read again, is the same to the bit.
void expect_survives_writing(const Frame&, const std::filesystem::path&);

}  // namespace strata
