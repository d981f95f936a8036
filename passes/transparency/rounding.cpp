#include "passes/transparency/rounding.h"

#include <algorithm>
#include <cmath>

namespace strata::transparency {

double rounded(double value, SmallFloat format, Rounding rounding) {
    if (value == 0 || !std::isfinite(value)) return value;
    constexpr int least_exponent = -14;
    const int exponent = std::max(std::ilogb(value), least_exponent);
    const double step = std::ldexp(1., exponent - format.bits);
    const double steps = rounding == Rounding::to_nearest ? std::nearbyint(value / step) : std::trunc(value / step);
    return std::clamp(steps * step, -format.largest, format.largest);
}

}  // namespace strata::transparency
