#include "passes/transparency/rounding.h"

#include <algorithm>
#include <cmath>

namespace strata::transparency {

double rounded(double value, SmallFloat format) {
    if (value == 0 || !std::isfinite(value)) return value;
    constexpr int least_exponent = -14;
    const int exponent = std::max(std::ilogb(value), least_exponent);
    const double step = std::ldexp(1., exponent - format.bits);
    return std::clamp(std::nearbyint(value / step) * step, -format.largest, format.largest);
}

}  // namespace strata::transparency
