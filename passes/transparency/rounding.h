// What is left of a number in the formats that sums are kept in, for models: a method's format is part of the method.
#pragma once

namespace strata::transparency {

/// Significand bits behind the leading one, and whether there is a sign; exponents are those of a half float.
struct SmallFloat {
    int bits = 10;
    double largest = 65504;
};
inline constexpr SmallFloat half_float = {10, 65504}, float11 = {6, 65024}, float10 = {5, 64512};

/// Rounded to nearest, ties to even, denormals kept, saturated as lavapipe's blending is (hardware goes to infinity, which the
/// resolves read as the largest number).
double rounded(double value, SmallFloat);

}  // namespace strata::transparency
