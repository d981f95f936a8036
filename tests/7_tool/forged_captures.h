// Captures whose checksums are right and whose contents lie: what a forger would write, one lie each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "capture_format/frame/stage_choice.h"

namespace strata {

struct ForgedCapture {
    std::string name;
    std::vector<std::byte> bytes;
    std::string id;  ///< of the error that refuses it, and what its fields begin with
};

std::vector<ForgedCapture> forged_captures();

/// A sound capture of several frames that build on each other, with a light, so that every verb has something to do.
std::vector<std::byte> sound_capture();
/// The same frames with names and notes that are not UTF-8 and that command a terminal, and a section of a type that does not
/// exist.
std::vector<std::byte> capture_with_unknown_section();
/// The same frames, made with these techniques when they were recorded.
std::vector<std::byte> capture_recorded_with(const std::vector<StageChoice>&);
/// A few kilobytes within every limit whose one texture takes 1 GiB.
std::vector<std::byte> vast_capture();

}  // namespace strata
