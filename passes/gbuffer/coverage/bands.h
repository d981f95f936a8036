// From alpha to covered samples, in double (docs/algorithms/deferred.md 4.2). Modes have the values of coverage.shared.h.
#pragma once

#include <cstdint>

namespace strata::gbuffer {

/// A place where a mode is asked.
struct BandPlace {
    std::uint32_t x = 0, y = 0;            ///< the pixel
    std::uint32_t draw = 0, triangle = 0;  ///< the surface: its draw, and the first vertex of the triangle in its mesh
};

/// The mode's dither at a place, 0 to 3.
std::uint32_t dither(std::uint32_t mode, const BandPlace&);
/// How many of 1 or 4 samples are covered.
std::uint32_t sample_count(std::uint32_t mode, std::uint32_t samples, double alpha, std::uint32_t dither);
/// Bit i: sample i is covered.
std::uint32_t sample_mask(std::uint32_t mode, std::uint32_t samples, double alpha, const BandPlace&);

}  // namespace strata::gbuffer
