// The ground y = 0 from 10 m above it: what facts of shadow lookups are computed on by hand.
#pragma once

#include <cstdint>

#include "capture_format/frame.h"

namespace strata {

inline constexpr double height_above_ground = 10;

/// `width` by `rows` pixels; the picture is `wide` meters wide on the ground, its middle at x = 0. Nothing is drawn.
Frame ground_from_above(std::uint32_t width, std::uint32_t rows, double wide);

/// Along +x and down, `angle` radians from the vertical, with one cascade.
void add_slanted_sun(Frame&, double angle, std::uint32_t map_size);

}  // namespace strata
