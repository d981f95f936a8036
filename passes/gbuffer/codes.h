// Half floats bit by bit, and integer codes in half-float channels (docs/algorithms/deferred.md 2.6), for the models. In double
// and integers.
#pragma once

#include <cstdint>

#include "passes/reference/shade.h"

namespace strata::gbuffer {

/// Nearest half float, ties to even; overflow becomes infinity.
std::uint16_t half_bits(double value);
double half_value(std::uint16_t bits);

/// Codes 0..61439 are the normal half floats 0400..7bff, 8400..fbff.
inline constexpr std::uint32_t code_count = 61440;
std::uint16_t half_of_code(std::uint32_t code);
std::uint32_t code_of_half(std::uint16_t bits);

/// What codes.glsl's nearest_half gives: no subnormals (0 or 2^-14 instead), no infinity (65504 instead).
double nearest_half(double value);

/// 8 bits of occlusion under a material number: 58 steps of metallic for each lighting model that has metals, then one number
/// for each that has none.
std::uint32_t material_code(const SurfacePoint&);

/// The point with base color and roughness as 8 bits keep them, the color on the sRGB curve.
SurfacePoint stored_color(SurfacePoint);

/// The point with base color, roughness, metallic, occlusion and lighting model as 8-bit sRGB and the material code keep them.
SurfacePoint stored_material(SurfacePoint);

}  // namespace strata::gbuffer
