// What is left of a number in the formats that sums are kept in, for models: a method's format is part of the method. Vulkan
// leaves the direction open; the blending of lavapipe 22.3 rounds 16 and 11 bits towards zero (200 layers of .01 then stop at
// 1.979 of 2.010, and R11G11B10F much earlier), hardware commonly to nearest.
#pragma once

namespace strata::transparency {

/// Significand bits behind the leading one, and whether there is a sign; exponents are those of a half float.
struct SmallFloat {
    int bits = 10;
    double largest = 65504;
};
inline constexpr SmallFloat half_float = {10, 65504}, float11 = {6, 65024}, float10 = {5, 64512};

/// Codes: of what shaders round themselves, see nearest_code().
enum class Rounding { towards_zero, to_nearest, to_nearest_code };

/// To nearest, but down from .503: a number halfway between two codes must not hang on how a float was rounded. Of what is >= 0.
double nearest_code(double);

/// Denormals kept, saturated at the largest number as lavapipe's blending is (hardware goes to infinity, which the resolves read
/// as the largest number).
double rounded(double value, SmallFloat, Rounding = Rounding::towards_zero);

}  // namespace strata::transparency
