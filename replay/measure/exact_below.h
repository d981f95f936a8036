// Errors that say nothing.
#pragma once

namespace strata {

/// Errors below it, relative or of white, are what rounding in float leaves of an exact blend.
inline constexpr double exact_below = 1e-4;

}  // namespace strata
