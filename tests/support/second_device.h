// A second Vulkan device for tests, independent of the one that all others run on: SwiftShader has a rasterizer and a compiler
// of its own. Tests that need it are skipped where it is not installed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture_format/frame.h"
#include "replay/session/session.h"

namespace strata {

/// What --gpu calls it: STRATA_SECOND_GPU, else SwiftShader.
std::string second_gpu();

/// The file that names its driver to the Vulkan loader: STRATA_SECOND_DRIVER, else where Debian's package chromium-common has it.
/// Empty: there is no such file.
std::string second_driver();

/// Why a test of the second device is skipped.
inline constexpr const char* no_second_driver =
    "the second device is not installed: apt install chromium-common, or set STRATA_SECOND_DRIVER to a Vulkan driver's JSON file";

/// A session on it, with the validation layer on.
std::unique_ptr<Session> second_session(std::vector<Frame>);

}  // namespace strata
