// What fog is measured along, and the truth of settings that measure it otherwise than it is recorded.
#pragma once

#include <cstdint>
#include <string_view>

namespace strata::combine {

/// The way through fog: view depth, as recorded (capture_format/frame.h), or what light travels from the surface to the eye.
enum class FogPath : std::uint32_t { view_depth, distance };

inline constexpr std::string_view fog_by_distance_truth = "fog by distance";

}  // namespace strata::combine
