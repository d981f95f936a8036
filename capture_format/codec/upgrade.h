// Frames of older format versions become frames of today: one function and one sentence per step. upgrade.cpp is the changelog.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// The version of frame sections this program writes.
inline constexpr std::uint32_t format_version = 2;

/// From version n to n + 1, where n is the step's place in the table plus 1.
struct UpgradeStep {
    std::string_view sentence;  ///< what changed its meaning
    Frame (*apply)(Frame);
};
std::span<const UpgradeStep> upgrade_steps();

/// Fails for a version this program does not know.
Result<void> check_format_version(std::uint32_t version);

/// Takes a frame of the given version through all later steps of the table.
Frame upgrade(Frame, std::uint32_t version, std::span<const UpgradeStep> steps = upgrade_steps());

}  // namespace strata
