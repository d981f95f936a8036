// The index that points at nothing.
#pragma once

#include <cstdint>

namespace strata {

/// Marks an index that points at nothing (no texture, no shadow, no list).
inline constexpr std::uint32_t no_index = 0xffffffffu;

}  // namespace strata
