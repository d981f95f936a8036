#include "passes/transparency/rounding.h"

#include <algorithm>
#include <cmath>

namespace strata::transparency {

double nearest_code(double x) { return std::floor(x + .497); }

double rounded(double value, SmallFloat format, Rounding rounding) {
    if (value == 0 || !std::isfinite(value)) return value;
    constexpr int least_exponent = -14;
    const int exponent = std::max(std::ilogb(value), least_exponent);
    const double step = std::ldexp(1., exponent - format.bits);
    const auto steps = [&](double x) {
        if (rounding == Rounding::to_nearest_code) return nearest_code(x);
        return rounding == Rounding::to_nearest ? std::nearbyint(x) : std::trunc(x);
    };
    return std::clamp(steps(value / step) * step, -format.largest, format.largest);
}

}  // namespace strata::transparency
