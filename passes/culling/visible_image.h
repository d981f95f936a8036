// The shape of FrameImages::visible: one texel per command of all_opaque, 1024 to a row.
#pragma once

#include <algorithm>
#include <cstdint>

namespace strata {

inline constexpr std::uint32_t visible_width = 1024;

/// At least one row, so that a frame without opaque draws still has the image.
inline std::uint32_t visible_rows(std::size_t draws) {
    return std::max<std::uint32_t>(1, static_cast<std::uint32_t>((draws + visible_width - 1) / visible_width));
}

}  // namespace strata
