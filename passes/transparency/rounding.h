// What is left of a number in the formats that sums are kept in, for models: a technique's format is part of the technique. Which
// way blending rounds is the device's: towards zero, 200 layers of alpha .01 sum up to 1.965 of 2.010 in half floats, and in
// R11G11B10F the sum stops at 1.
#pragma once

#include <optional>

#include "passes/blend_rounding.h"

namespace strata::transparency {

/// Significand bits behind the leading one, and whether there is a sign; exponents are those of a half float.
struct SmallFloat {
    int bits = 10;
    double largest = 65504;
};
inline constexpr SmallFloat half_float = {10, 65504}, float11 = {6, 65024}, float10 = {5, 64512};

/// To nearest, but down from .503: a number halfway between two codes must not hang on how a float was rounded. Of what is >= 0.
double nearest_code(double);
/// The same for codes of a format, as shaders round them.
double nearest_code(double value, SmallFloat);

/// Denormals kept, saturated at the largest number as lavapipe's blending is (hardware goes to infinity, which the resolves read
/// as the largest number).
double rounded(double value, SmallFloat, Rounding);
/// As a device rounds what it blends into the format.
double rounded(double value, SmallFloat, BlendRounding);
/// A half float; without a direction the number itself: the technique in exact arithmetic.
double in_half(double value, std::optional<Rounding>);

}  // namespace strata::transparency
