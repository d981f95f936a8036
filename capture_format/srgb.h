// The piecewise curve of IEC 61966-2-1, and bytes of 0..1. Every constant is rounded to the type that computes, so float and
// double each give what the formula written in that type gives. The references decode with their own
// (passes/reference/textures.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace strata {

/// Display value 0..1 to linear.
template <std::floating_point T>
T decode_srgb(T value) {
    return value <= T(0.04045) ? value / T(12.92) : std::pow((value + T(0.055)) / T(1.055), T(2.4));
}

/// Linear 0..1 to display value.
template <std::floating_point T>
T encode_srgb(T value) {
    return value <= T(0.0031308) ? value * T(12.92) : T(1.055) * std::pow(value, 1 / T(2.4)) - T(0.055);
}

/// The nearest of the 256 steps of 0..1; what lies outside is clamped. No NaN.
template <std::floating_point T>
std::byte unorm8(T value) {
    return static_cast<std::byte>(std::lround(std::clamp(value, T(0), T(1)) * 255));
}

}  // namespace strata
