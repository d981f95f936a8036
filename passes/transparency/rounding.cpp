#include "passes/transparency/rounding.h"

#include <algorithm>
#include <cmath>

namespace strata::transparency {
namespace {

/// Rounds a number of steps of the format to a whole one by `round`.
template <typename Round>
double in_steps(double value, SmallFloat format, Round round) {
    if (value == 0 || !std::isfinite(value)) return value;
    constexpr int least_exponent = -14;
    const int exponent = std::max(std::ilogb(value), least_exponent);
    const double step = std::ldexp(1., exponent - format.bits);
    return std::clamp(round(value / step) * step, -format.largest, format.largest);
}

}  // namespace

double nearest_code(double x) { return std::floor(x + .497); }

double nearest_code(double value, SmallFloat format) {
    return in_steps(value, format, [](double steps) { return nearest_code(steps); });
}

double rounded(double value, SmallFloat format, Rounding rounding) {
    return in_steps(value, format,
                    [&](double steps) { return rounding == Rounding::to_nearest ? std::nearbyint(steps) : std::trunc(steps); });
}

double rounded(double value, SmallFloat format, BlendRounding device) {
    return rounded(value, format, format.bits == half_float.bits ? device.half : device.packed);
}

double in_half(double value, std::optional<Rounding> rounding) {
    return rounding ? rounded(value, half_float, *rounding) : value;
}

}  // namespace strata::transparency
